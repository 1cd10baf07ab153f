"""A tape cut in two: what is computed once a call, and what every step repeats."""

from __future__ import annotations

from dataclasses import replace

from rrnn_opt.symbolic.tape import Instruction, Port, Tape


def split(tape: Tape, moving: frozenset[int]) -> tuple[Tape, Tape]:
    """Cut a tape where values stop to depend on the moving arguments.

    Args:
        tape: of a function.
        moving: arguments, by index, that change from step to step.

    Returns:
        ``setup`` from the other arguments to "work", and ``iterate`` from the
        moving arguments and "work" to the results.  One after the other they
        make exactly the operations of the tape.
    """
    values = tape.instructions[: tape.n_values]
    still = _still(values, moving)
    shared = _shared(tape, still)
    work = Port("work", (max(len(shared), 1), 1))
    place = {value: k for k, value in enumerate(shared)}
    fixed = [k for k in range(len(tape.inputs)) if k not in moving]
    setup = _setup(tape, still, fixed, shared, work)
    return setup, _iterate(tape, still, sorted(moving), place, work)


def _still(values: tuple[Instruction, ...], moving: frozenset[int]) -> list[bool]:
    """Whether each value is the same in every step."""
    still: list[bool] = []
    for step in values:
        own = step.slot is None or step.slot[0] not in moving
        still.append(own and all(still[a] for a in step.args))
    return still


def _shared(tape: Tape, still: list[bool]) -> list[int]:
    """Values that do not move and are read by what does, or by a result."""
    read = {
        a
        for step in tape.instructions
        if step.out < 0 or not still[step.out]
        for a in step.args
    }
    return [k for k in sorted(read) if still[k] and tape.instructions[k].const is None]


def _setup(
    tape: Tape, still: list[bool], fixed: list[int], shared: list[int], work: Port
) -> Tape:
    needed = set(shared)
    for step in reversed(tape.instructions[: tape.n_values]):
        if step.out in needed:
            needed.update(step.args)
    number: dict[int, int] = {}
    out: list[Instruction] = []
    for step in tape.instructions[: tape.n_values]:
        if still[step.out] and step.out in needed:
            slot = (
                None if step.slot is None else (fixed.index(step.slot[0]), step.slot[1])
            )
            out.append(_renamed(step, number, slot))
    results = [
        Instruction("output", -1, (number[value],), None, (0, k))
        for k, value in enumerate(shared)
    ]
    ports = tuple(tape.inputs[k] for k in fixed)
    return Tape("setup", ports, (work,), (*out, *results), len(number))


def _iterate(
    tape: Tape, still: list[bool], moving: list[int], place: dict[int, int], work: Port
) -> Tape:
    number: dict[int, int] = {}
    out: list[Instruction] = []
    for step in tape.instructions[: tape.n_values]:
        if step.out in place:
            read = Instruction("input", 0, (), None, (len(moving), place[step.out]))
            out.append(replace(read, out=len(number)))
            number[step.out] = len(number)
        elif step.const is not None or not still[step.out]:
            slot = None
            if step.slot is not None:
                slot = (moving.index(step.slot[0]), step.slot[1])
            out.append(_renamed(step, number, slot))
    results = [
        replace(step, args=tuple(number[a] for a in step.args))
        for step in tape.instructions[tape.n_values :]
    ]
    ports = (*(tape.inputs[k] for k in moving), work)
    return Tape("iterate", ports, tape.outputs, (*out, *results), len(number))


def _renamed(
    step: Instruction, number: dict[int, int], slot: tuple[int, int] | None
) -> Instruction:
    args = tuple(number[a] for a in step.args)
    number[step.out] = len(number)
    return Instruction(step.op, number[step.out], args, step.const, slot)
