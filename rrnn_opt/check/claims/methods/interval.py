"""Method "interval": a tree of boxes, on each of which the claim is evident.

The payload is a tree of cuts (:mod:`rrnn_opt.check.claims.graph.tree`).  Only its
leaves are looked at: on each one every element of the goal keeps its sense, or
one hypothesis is broken all over the box, by the natural interval form or by
the mean-value form f(c) + f'(X) (X - c).  Leaves are evaluated in doubles
rounded outwards, and in ball arithmetic: all of them where there are few, else
a hundredth, drawn by the digest of the tree.  A leaf that this arithmetic finds
too wide is halved a few times.
"""

from __future__ import annotations

import functools
from types import ModuleType
from typing import Any

import flint
import numpy as np

from rrnn_opt.check.arithmetic import ball_intervals, intervals
from rrnn_opt.check.arithmetic.intervals import Array
from rrnn_opt.check.claims.answer import Answer
from rrnn_opt.check.claims.document import ClaimGraph
from rrnn_opt.check.claims.graph import boxes
from rrnn_opt.check.claims.graph.tree import Leaves, halves, leaves, read_tree
from rrnn_opt.errors import UndecidedError

FEW, SHARE = 100, 0.01
DEEPEST = 8
PRECISION = 64
_BLOCK = 2048


def judge(graph: ClaimGraph, payload: Any, document: Any) -> Answer:
    """Look at every leaf.

    Raises:
        UndecidedError: the goal is an equation, the domain has no bounds, or a
            leaf is not confirmed.
        DocumentError: the payload is not readable.
    """
    if graph.senses[0] == "==0":
        raise UndecidedError("boxes do not prove an equation")
    found = leaves(graph, read_tree(payload))
    statement = _Statement(graph)
    for block in range(0, len(found.plain), _BLOCK):
        part = slice(block, block + _BLOCK)
        low, high, plain = found.lower[:, part], found.upper[:, part], found.plain[part]
        statement.confirm(low[:, plain], high[:, plain], "natural")
        statement.confirm(low[:, ~plain], high[:, ~plain], "mean value")
    every = len(found.plain) <= FEW
    count = _in_balls(statement, found, every, payload["sha256"])
    reason = f"shown on each of {len(found.plain)} boxes, {count} of them in balls"
    return Answer("PROVED", reason, "arb" if every else "interval")


def _in_balls(statement: _Statement, found: Leaves, every: bool, digest: str) -> int:
    total = len(found.plain)
    chosen = np.arange(total)
    if not every:
        rng = np.random.default_rng(int(digest[:16], 16))
        chosen = rng.choice(total, max(FEW, int(SHARE * total)), replace=False)
    with flint.ctx.workprec(PRECISION):
        for k in chosen.tolist():
            if not statement.in_balls(found.lower[:, k], found.upper[:, k]):
                raise UndecidedError("ball arithmetic does not confirm a leaf")
    return len(chosen)


class _Statement:
    """The relations of a claim, and where a box shows them."""

    def __init__(self, graph: ClaimGraph) -> None:
        self._graph = graph
        self._slots = [
            (i, k) for i, port in enumerate(graph.inputs) for k in range(port.size)
        ]
        self._elements = [
            (sense, boxes.result(graph, j, k), j == 0)
            for j, (sense, port) in enumerate(
                zip(graph.senses, graph.outputs, strict=True)
            )
            for k in range(port.size)
        ]

    def confirm(self, low: Array, high: Array, form: str, depth: int = 0) -> None:
        """Show every box; those that resist are halved.

        Raises:
            UndecidedError: a box still resists.
        """
        if not low.shape[1]:
            return
        with np.errstate(all="ignore"):
            left = ~self._shown(intervals, low, high, form)
        if not left.any():
            return
        if depth == DEEPEST:
            raise UndecidedError(f"{left.sum()} boxes are not confirmed")
        low, high = low[:, left], high[:, left]
        if form == "mean value":
            low, high = halves(low, high, np.argmax(high - low, axis=0))
            depth += 1
        self.confirm(low, high, "mean value", depth)

    def in_balls(self, low: Array, high: Array, depth: int = 0) -> bool:
        """Whether ball arithmetic shows one box, halved where that is needed."""
        for form in ("natural", "mean value"):
            if self._shown(ball_intervals, low, high, form):
                return True
        if depth == DEEPEST:
            return False
        axis = np.array([np.argmax(high - low)])
        lows, highs = halves(low[:, None], high[:, None], axis)
        return all(self.in_balls(lows[:, k], highs[:, k], depth + 1) for k in range(2))

    def _shown(self, on: ModuleType, low: Array, high: Array, form: str) -> Any:
        """Goal kept all over a box, or a hypothesis broken all over it."""
        form_of = self._natural if form == "natural" else self._mean_value
        enclosure = form_of(on, low, high)
        kept: Any = True
        for sense, last, is_goal in self._elements:
            if is_goal:
                kept = kept & _keeps(sense, *enclosure(last))
        if not np.all(kept):
            for sense, last, is_goal in self._elements:
                if not is_goal:
                    kept = kept | _breaks(sense, *enclosure(last))
        return kept

    def _natural(self, on: ModuleType, low: Array, high: Array) -> Any:
        box = {s: on.interval(low[i], high[i]) for i, s in enumerate(self._slots)}
        known = boxes.values(self._graph, on, box)
        undefined = _undefined(on, known) + 0.0 * low[0]

        def enclosure(last: int | None) -> tuple[Any, Any]:
            x = on.constant(0.0) if last is None else known[last]
            return on.lower(x) + undefined, on.upper(x) + undefined

        return enclosure

    def _mean_value(self, on: ModuleType, low: Array, high: Array) -> Any:
        middle = low + 0.5 * (high - low)
        box, point, away = {}, {}, {}
        for i, slot in enumerate(self._slots):
            box[slot] = on.interval(low[i], high[i])
            point[slot] = on.interval(middle[i], middle[i])
            away[slot] = on.sub(box[slot], point[slot])
        graph = self._graph
        known = boxes.values(graph, on, box)
        at = boxes.values(graph, on, point)
        undefined = _undefined(on, known) + 0.0 * low[0]
        slopes = {slot: boxes.tangents(graph, on, known, slot) for slot in self._slots}

        @functools.cache
        def enclosure(last: int | None) -> tuple[Any, Any]:
            x = on.constant(0.0) if last is None else known[last]
            if last is not None and boxes.smooth(graph, last):
                y = at[last]
                for slot, tangent in slopes.items():
                    if tangent[last] is not None:
                        y = on.add(y, on.mul(tangent[last], away[slot]))
                x = on.meet(x, y)
            return on.lower(x) + undefined, on.upper(x) + undefined

        return enclosure


def _undefined(on: ModuleType, known: list[Any]) -> Any:
    """0, or NaN where any value of the graph is not defined or not bounded."""
    total: Any = 0.0
    for x in known:
        total = total + 0.0 * (on.upper(x) - on.lower(x))
    return total


def _keeps(sense: str, low: Any, high: Any) -> Any:
    return {
        ">=0": lambda: low >= 0,
        ">0": lambda: low > 0,
        "<=0": lambda: high <= 0,
        "<0": lambda: high < 0,
    }[sense]()


def _breaks(sense: str, low: Any, high: Any) -> Any:
    return {
        ">=0": lambda: high < 0,
        ">0": lambda: high <= 0,
        "<=0": lambda: low > 0,
        "<0": lambda: low >= 0,
        "==0": lambda: (low > 0) | (high < 0),
    }[sense]()
