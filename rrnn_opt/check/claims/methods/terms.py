"""Method "terms": every term of the goal has one sign on the domain."""

from __future__ import annotations

from typing import Any

from rrnn_opt.check.claims.answer import Answer, undefined
from rrnn_opt.check.claims.document import ClaimGraph
from rrnn_opt.check.claims.graph.polynomial import normal_forms
from rrnn_opt.check.claims.graph.term_signs import never_negative
from rrnn_opt.errors import UndecidedError


def judge(graph: ClaimGraph, payload: Any, document: Any) -> Answer:
    """Every term of the goal has the sign that is claimed, on the domain.

    Raises:
        UndecidedError: the goal is an equation, or the terms differ in sign.
    """
    sense = graph.senses[0]
    if sense == "==0":
        raise UndecidedError("signs of terms do not prove an equation")
    forms = normal_forms(graph)
    factor = 1 if sense in (">=0", ">0") else -1
    for element in range(graph.outputs[0].size):
        polynomial = forms.results.get((0, element), 0) * factor
        strict = "=" not in sense
        if not never_negative(polynomial, forms, graph.domain, strict=strict):
            raise UndecidedError(f"element {element}: the terms differ in sign")
    reason = "every term has the claimed sign on the domain"
    return Answer("PROVED", reason, "exact", undefined(forms.partial))
