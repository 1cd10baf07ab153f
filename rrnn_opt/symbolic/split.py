"""A tape cut in two: what is computed once, and what every step repeats."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from rrnn_opt.errors import RrnnError
from rrnn_opt.symbolic.tape import Instruction, Port, Tape

WORK = "work"
"""Name of the last result of the first tape and last argument of the second."""


def split(
    tape: Tape, late: Collection[int], early_results: Collection[int] = ()
) -> tuple[Tape, Tape]:
    """Everything that does not depend on some arguments, and the rest.

    The first tape has the other arguments, and as results the named ones and
    ``WORK``, the values that the second one needs besides the late arguments (one
    zero when it needs none).  Both do the same operations as the whole.

    Args:
        tape: the function.
        late: arguments that change from step to step, by index.
        early_results: results of the first tape, by index.

    Returns:
        First and second tape.

    Raises:
        RrnnError: an early result depends on a late argument.
    """
    values, results = (
        tape.instructions[: tape.n_values],
        tape.instructions[tape.n_values :],
    )
    moving: set[int] = set()
    for step in values:
        given = step.slot is not None and step.slot[0] in late
        if given or not moving.isdisjoint(step.args):
            moving.add(step.out)
    now = [s for s in results if s.slot and s.slot[0] in early_results]
    then = [s for s in results if s.slot and s.slot[0] not in early_results]
    if any(s.args[0] in moving for s in now):
        raise RrnnError(f"{tape.name}: an early result depends on a late argument")
    fixed = {s.out for s in values if s.const is not None}
    needed = {
        a for s in (*(v for v in values if v.out in moving), *then) for a in s.args
    }
    passed = sorted(needed - moving - fixed)
    return _first(tape, late, now, passed), _second(tape, late, then, moving, passed)


def only(tape: Tape, results: Collection[int]) -> Tape:
    """The tape with some of its results, by index, and all its arguments."""
    kept = sorted(results)
    taken = [
        Instruction("output", -1, s.args, None, (kept.index(s.slot[0]), s.slot[1]))
        for s in tape.instructions[tape.n_values :]
        if s.slot and s.slot[0] in kept
    ]
    ports = tuple(tape.outputs[k] for k in kept)
    return _tape(tape, tape.inputs, ports, tape.instructions[: tape.n_values], taken)


def _first(
    tape: Tape, late: Collection[int], now: list[Instruction], passed: list[int]
) -> Tape:
    inputs = [k for k in range(len(tape.inputs)) if k not in late]
    order = sorted({s.slot[0] for s in now if s.slot})
    values = [
        _moved(s, {k: (inputs.index(k), 0) for k in inputs})
        for s in tape.instructions[: tape.n_values]
        if s.slot is None or s.slot[0] in inputs
    ]
    results = [
        Instruction("output", -1, s.args, None, (order.index(s.slot[0]), s.slot[1]))
        for s in now
        if s.slot
    ]
    results += [
        Instruction("output", -1, (value,), None, (len(order), k))
        for k, value in enumerate(passed)
    ]
    ports = [*(tape.outputs[k] for k in order), _port(passed)]
    return _tape(tape, [tape.inputs[k] for k in inputs], ports, values, results)


def _second(
    tape: Tape,
    late: Collection[int],
    then: list[Instruction],
    moving: set[int],
    passed: list[int],
) -> Tape:
    inputs = sorted(late)
    order = [
        k for k in range(len(tape.outputs)) if k in {s.slot[0] for s in then if s.slot}
    ]
    place = {value: k for k, value in enumerate(passed)}
    values = []
    for step in tape.instructions[: tape.n_values]:
        if step.out in place:
            slot = (len(inputs), place[step.out])
            values.append(Instruction("input", step.out, (), None, slot))
        elif step.const is not None or step.out in moving:
            values.append(_moved(step, {k: (inputs.index(k), 0) for k in inputs}))
    results = [
        Instruction("output", -1, s.args, None, (order.index(s.slot[0]), s.slot[1]))
        for s in then
        if s.slot
    ]
    ports = [*(tape.inputs[k] for k in inputs), _port(passed)]
    return _tape(tape, ports, [tape.outputs[k] for k in order], values, results)


def _port(passed: list[int]) -> Port:
    return Port(WORK, (max(len(passed), 1), 1))


def _moved(step: Instruction, where: dict[int, tuple[int, int]]) -> Instruction:
    """The instruction with its argument's new index."""
    if step.slot is None:
        return step
    index = where[step.slot[0]][0]
    return Instruction(step.op, step.out, step.args, step.const, (index, step.slot[1]))


def _tape(
    like: Tape,
    inputs: Iterable[Port],
    outputs: Iterable[Port],
    values: Iterable[Instruction],
    results: Iterable[Instruction],
) -> Tape:
    """A tape of what the results need, numbered without gaps."""
    steps, taken = list(values), list(results)
    needed = {a for s in taken for a in s.args}
    for step in reversed(steps):
        if step.out in needed:
            needed.update(step.args)
    number: dict[int, int] = {}
    alive = []
    for step in (*(s for s in steps if s.out in needed), *taken):
        args = tuple(number[a] for a in step.args)
        if step.op != "output":
            number[step.out] = len(number)
        out = number.get(step.out, -1) if step.op != "output" else -1
        alive.append(Instruction(step.op, out, args, step.const, step.slot))
    return Tape(like.name, tuple(inputs), tuple(outputs), tuple(alive), len(number))
