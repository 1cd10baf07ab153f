"""Reading a claim that is written down as plain data.

The graph of a claim arrives as lists and strings (JSON).  Nothing of it is
believed: every reference is checked, and the fingerprint is computed again
from what was read.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from rrnn_opt.errors import DocumentError

SENSES = ("==0", ">=0", "<=0", ">0", "<0")
WHERE = "claim certificate"
Bound = Fraction | None
Element = tuple[int, int]
MAX_SIZE = 100_000
_RATIONAL = re.compile(r"-?[0-9]{1,4000}(/[0-9]{1,4000})?")


@dataclass(frozen=True)
class Step:
    """One operation; ``out`` is -1 for a result."""

    op: str
    out: int
    args: tuple[int, ...]
    const: float | None
    slot: Element | None


@dataclass(frozen=True)
class Port:
    """Name and dense shape of a variable or a result."""

    name: str
    shape: tuple[int, int]

    @property
    def size(self) -> int:
        """Number of elements."""
        return self.shape[0] * self.shape[1]


@dataclass(frozen=True)
class ClaimGraph:
    """A claim as read: single-assignment graph, senses, domain.

    Attributes:
        inputs: variables.
        outputs: the goal, then the hypotheses that have a relation.
        steps: values in order of evaluation, then results.
        senses: one for every output.
        worded: ids of hypotheses that are said in words only.
        added: hypotheses that the source does not state, "id: statement".
        domain: (lower, upper) by (variable, element); None: no bound.
        fingerprint: computed from all of this.
    """

    inputs: tuple[Port, ...]
    outputs: tuple[Port, ...]
    steps: tuple[Step, ...]
    senses: tuple[str, ...]
    worded: tuple[str, ...]
    added: tuple[str, ...]
    domain: Mapping[Element, tuple[Bound, Bound]]
    fingerprint: str


def read_claim(data: Mapping[str, Any]) -> ClaimGraph:
    """Read the "claim" block of a certificate.

    Args:
        data: the block; see :mod:`rrnn_opt.check.claims.certificate`.

    Raises:
        DocumentError: something is missing, of a wrong kind, or refers to
            what does not exist.
    """
    try:
        inputs, outputs = _ports(data["inputs"]), _ports(data["outputs"])
        steps = tuple(_step(row) for row in data["tape"])
        senses = tuple(str(sense) for sense in data["senses"])
        ranges = [_range(row, inputs) for row in data["domain"]]
        assumed = [_assumed(row) for row in data["hypotheses"]]
        order, jacobian = data["order"], data["jacobian"]
    except (KeyError, TypeError, ValueError, ArithmeticError) as error:
        raise DocumentError(WHERE, f"not readable ({error!r})") from error
    _require(len(senses) == len(outputs) > 0, "one sense for every output")
    related = sum(not worded for _, _, worded, _ in assumed)
    _require(related == len(senses) - 1, "one result for every hypothesis")
    _require(all(sense in SENSES for sense in senses), f"senses are {SENSES}")
    _check_steps(steps, inputs, outputs)
    content = [
        _tape_fingerprint(inputs, outputs, steps),
        list(senses),
        sorted((i, [str(x) for x in (*low, *high)]) for i, low, high in ranges),
        order,
        jacobian,
        [[(worded or added) and text, added] for _, text, worded, added in assumed],
    ]
    fingerprint = hashlib.sha256(json.dumps(content).encode()).hexdigest()
    domain = _domain(ranges)
    words = tuple(name for name, _, worded, _ in assumed if worded)
    extra = tuple(f"{name}: {text}" for name, text, _, added in assumed if added)
    return ClaimGraph(inputs, outputs, steps, senses, words, extra, domain, fingerprint)


def read_rational(text: object) -> Fraction:
    """A number written exactly: "3/4", "-2".

    Raises:
        ValueError: it is not.
    """
    if not (isinstance(text, str) and _RATIONAL.fullmatch(text)):
        raise ValueError(f"{text!r} is not an exact number written as text")
    return Fraction(text)


def _require(condition: bool, message: str) -> None:
    if not condition:
        raise DocumentError(WHERE, message)


def _ports(rows: Sequence[Any]) -> tuple[Port, ...]:
    ports = tuple(Port(str(name), (int(r), int(c))) for name, (r, c) in rows)
    _require(all(min(p.shape) >= 1 for p in ports), "shapes are positive")
    _require(sum(p.size for p in ports) <= MAX_SIZE, f"at most {MAX_SIZE} elements")
    _require(len({p.name for p in ports}) == len(ports), "names are unique")
    return ports


def _step(row: Sequence[Any]) -> Step:
    op, out, args, const, slot = row
    _require(slot is None or len(slot) == 2, "a slot is a port and an element")
    return Step(
        str(op),
        int(out),
        tuple(int(a) for a in args),
        None if const is None else float.fromhex(const),
        None if slot is None else (int(slot[0]), int(slot[1])),
    )


def _assumed(row: Sequence[Any]) -> tuple[str, str, bool, bool]:
    name, text, worded, added = row
    return str(name), str(text), bool(worded), bool(added)


def _range(
    row: Mapping[str, Any], inputs: Sequence[Port]
) -> tuple[int, list[Bound], list[Bound]]:
    index = [p.name for p in inputs].index(row["variable"])
    sides = [
        [None if x is None else read_rational(x) for x in row[side]]
        for side in ("lower", "upper")
    ]
    _require(
        all(len(side) == inputs[index].size for side in sides), "one bound an element"
    )
    return index, sides[0], sides[1]


def _domain(
    ranges: Sequence[tuple[int, list[Bound], list[Bound]]],
) -> dict[Element, tuple[Bound, Bound]]:
    domain: dict[Element, tuple[Bound, Bound]] = {}
    for index, lower, upper in ranges:
        for element, (low, high) in enumerate(zip(lower, upper, strict=True)):
            before = domain.get((index, element), (None, None))
            lows = [x for x in (low, before[0]) if x is not None]
            highs = [x for x in (high, before[1]) if x is not None]
            both = max(lows, default=None), min(highs, default=None)
            empty = both[0] is not None and both[1] is not None and both[0] > both[1]
            _require(not empty, "a range of it is empty")
            domain[index, element] = both
    return domain


def _check_steps(
    steps: Sequence[Step], inputs: Sequence[Port], outputs: Sequence[Port]
) -> None:
    """Single assignment, and no reference to what does not exist."""
    count = 0
    written: set[Element] = set()
    for step in steps:
        _require(all(0 <= a < count for a in step.args), "an operand is not defined")
        if step.op == "output":
            _require(_fits(step.slot, outputs), "a result has no place")
            _require(len(step.args) == 1 and step.slot not in written, "a bad result")
            written.add(step.slot)  # type: ignore[arg-type]
            continue
        _require(not written, "results come last")
        _require(step.out == count, "values are numbered in order")
        _require((step.op == "input") == (step.slot is not None), "a bad slot")
        _require(step.op != "input" or _fits(step.slot, inputs), "no such input")
        _require((step.op == "const") == (step.const is not None), "a bad constant")
        count += 1


def _fits(slot: Element | None, ports: Sequence[Port]) -> bool:
    return (
        slot is not None
        and 0 <= slot[0] < len(ports)
        and 0 <= slot[1] < ports[slot[0]].size
    )


def _tape_fingerprint(
    inputs: Sequence[Port], outputs: Sequence[Port], steps: Sequence[Step]
) -> str:
    """SHA-256 over ports and operations, constants as hexadecimal floats."""
    digest = hashlib.sha256()
    for port in (*inputs, None, *outputs):
        digest.update(f"{port and (port.name, port.shape)}\n".encode())
    for step in steps:
        const = None if step.const is None else step.const.hex()
        line = f"{step.op} {step.out} {step.args} {const} {step.slot}\n"
        digest.update(line.encode())
    return digest.hexdigest()
