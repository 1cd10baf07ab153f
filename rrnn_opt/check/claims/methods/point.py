"""Method "point": a domain of one point, at which the goal certainly holds.

Where every element of every variable has the same lower and upper bound, the
claim speaks of one point, and "for all" is a computation: rationals where the
operations allow it, balls elsewhere.
"""

from __future__ import annotations

from typing import Any

from rrnn_opt.check.claims.answer import Answer
from rrnn_opt.check.claims.document import ClaimGraph
from rrnn_opt.check.claims.graph.point import replay
from rrnn_opt.errors import UndecidedError

_KEEPS = {"==0": (0,), ">=0": (0, 1), "<=0": (-1, 0), ">0": (1,), "<0": (-1,)}


def judge(graph: ClaimGraph, payload: Any, document: Any) -> Answer:
    """Evaluate the goal at the only point of the domain.

    Raises:
        UndecidedError: the domain has more points, or the goal fails there.
    """
    point = {}
    for index, port in enumerate(graph.inputs):
        for k in range(port.size):
            low, high = graph.domain.get((index, k), (None, None))
            if low is None or low != high:
                raise UndecidedError(f"'{port.name}' has more than one value")
            point[index, k] = low
    signs = replay(graph, point)
    if not all(sign in _KEEPS[graph.senses[0]] for sign in signs.signs[0]):
        raise UndecidedError("the goal fails at the only point of the domain")
    reason = f"{len(signs.signs[0])} values computed at the only point"
    return Answer("PROVED", reason, signs.trust)
