"""Method "identity": the normal form of every element of the goal is 0."""

from __future__ import annotations

from typing import Any

from flint import arb

from rrnn_opt.check.claims.answer import Answer, undefined
from rrnn_opt.check.claims.document import ClaimGraph
from rrnn_opt.check.claims.graph.polynomial import normal_forms
from rrnn_opt.errors import UndecidedError


def judge(graph: ClaimGraph, payload: Any, document: Any) -> Answer:
    """Expand the goal; hypotheses, domain and payload are not needed.

    Raises:
        UndecidedError: the goal is strict, or its normal form is not 0.
    """
    if graph.senses[0] not in ("==0", ">=0", "<=0"):
        raise UndecidedError("an identity does not prove a strict inequality")
    forms = normal_forms(graph)
    left = {slot: p for slot, p in forms.results.items() if p != 0}
    if left:
        (_, element), polynomial = min(left.items())
        largest = arb(max(abs(c) for c in polynomial.coeffs())).str(2, radius=False)
        raise UndecidedError(
            f"{len(left)} of {graph.outputs[0].size} elements do not vanish; element"
            f" {element} keeps {len(polynomial)} terms, the largest coefficient"
            f" {largest}"
        )
    reason = "the normal form is identically 0"
    return Answer("PROVED", reason, "exact", undefined(forms.partial))
