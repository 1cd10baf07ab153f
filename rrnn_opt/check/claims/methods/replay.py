"""Method "replay": a point of the domain that keeps the hypotheses and breaks the goal.

The same replay shows that a proof is not vacuous: some point keeps them.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from rrnn_opt.check.claims.answer import Answer
from rrnn_opt.check.claims.document import WHERE, ClaimGraph, Element, read_rational
from rrnn_opt.check.claims.graph.point import Replay, replay
from rrnn_opt.errors import DocumentError, UndecidedError

_KEEPS = {"==0": (0,), ">=0": (0, 1), "<=0": (-1, 0), ">0": (1,), "<0": (-1,)}


def judge(graph: ClaimGraph, payload: Any, document: Any) -> Answer:
    """The witness lies in the domain, keeps the hypotheses, breaks the goal.

    Raises:
        UndecidedError: it does not, or a hypothesis stands in words only.
        DocumentError: the witness is not readable.
    """
    if graph.worded:
        named = ", ".join(graph.worded)
        raise UndecidedError(f"hypotheses in words only ({named}) cannot be replayed")
    seen = _admitted(graph, document.get("witness"), skip=None)
    for element, sign in enumerate(seen.signs[0]):
        if sign not in _KEEPS[graph.senses[0]]:
            value = seen.values[0][element]
            reason = f"at the witness element {element} of the goal is {value}"
            return Answer("REFUTED", reason, seen.trust)
    raise UndecidedError("the goal holds at the witness")


def require_admitted(graph: ClaimGraph, witness: Any) -> None:
    """Ask that a point lies in the domain, keeps the hypotheses, and has a goal.

    Args:
        graph: claim as read.
        witness: {variable: ["p/q", ...]}.

    Raises:
        UndecidedError: it lies elsewhere, breaks a hypothesis, or the graph is
            not defined there.
        DocumentError: the witness is not readable.
    """
    _admitted(graph, witness, skip=0)


def _admitted(graph: ClaimGraph, witness: Any, *, skip: int | None) -> Replay:
    point = _point(graph, witness)
    _require_domain(graph, point)
    seen = replay(graph, point, skip=skip)
    for signs, sense in zip(seen.signs[1:], graph.senses[1:], strict=True):
        if not all(sign in _KEEPS[sense] for sign in signs):
            raise UndecidedError("the witness breaks a hypothesis")
    return seen


def _point(graph: ClaimGraph, witness: Any) -> dict[Element, Fraction]:
    point: dict[Element, Fraction] = {}
    try:
        for index, port in enumerate(graph.inputs):
            numbers = [read_rational(x) for x in witness[port.name]]
            if len(numbers) != port.size:
                raise ValueError(f"'{port.name}' has {port.size} elements")
            point.update({(index, k): x for k, x in enumerate(numbers)})
    except (KeyError, TypeError, ValueError, ZeroDivisionError) as error:
        raise DocumentError(WHERE, f"witness not readable ({error!r})") from error
    return point


def _require_domain(graph: ClaimGraph, point: Mapping[Element, Fraction]) -> None:
    for slot, (low, high) in graph.domain.items():
        x = point[slot]
        if (low is not None and x < low) or (high is not None and x > high):
            name = graph.inputs[slot[0]].name
            raise UndecidedError(f"the witness leaves the domain ('{name}')")
