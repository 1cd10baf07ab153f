"""A batch of random graphs over random boxes, and the values outside."""

from __future__ import annotations

import casadi as ca
import flint
import numpy as np

from benchmarks.interval_soundness.graphs import random_box, random_graph
from rrnn_opt.check.arithmetic import ball_intervals, intervals
from rrnn_opt.check.claims.document import ClaimGraph, read_claim
from rrnn_opt.check.claims.graph import boxes
from rrnn_opt.claim import Claim, Relation
from rrnn_opt.errors import UnsupportedOperationError
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification.document import claim_block
from rrnn_opt.verification.engines.interval.forms import Forms

INPUTS, GRAPHS, BOXES = 3, 10, 100


def batch(seed: int, graphs: int = GRAPHS, count: int = BOXES) -> tuple[int, int]:
    """How many values are outside, and how many graphs are bounded on a box."""
    rng = np.random.default_rng(seed)
    x = ca.SX.sym("x", INPUTS)
    several = [random_graph(rng, inputs=INPUTS) for _ in range(graphs)]
    ends = [random_box(rng, INPUTS) for _ in range(count)]
    lower, upper = (np.stack(side, axis=1) for side in zip(*ends, strict=True))
    outside = bounded = 0
    for function in several:
        value = function(x)
        try:
            forms = Forms.of(x, [value])
        except UnsupportedOperationError:
            continue  # a constant that overflowed: refused, hence UNKNOWN
        natural = forms.value(lower, upper)
        tighter = natural
        if forms.slope is not None:
            tighter, _ = forms.mean_value(lower, upper, natural)
        graph = _graph(x, value)
        bounded += int(natural.bounded.sum())
        for k in np.flatnonzero(natural.bounded):
            for point in _points(rng, lower[:, k], upper[:, k]):
                low, high = _value(graph, point)
                for form in (natural, tighter):
                    outside += not (
                        form.lower[0, k] <= high and low <= form.upper[0, k]
                    )
                outside += not _in_checker(graph, lower[:, k], upper[:, k], low, high)
    return outside, bounded


def _graph(x: ca.SX, value: ca.SX) -> ClaimGraph:
    symbol = Symbol("x", x, "1", "unknowns")
    return read_claim(claim_block(Claim("s", "", "", (symbol,), Relation(value, ">0"))))


def _points(
    rng: np.random.Generator, lower: np.ndarray, upper: np.ndarray
) -> list[np.ndarray]:
    """Corners and inner points."""
    shares = np.vstack([rng.integers(0, 2, (2, INPUTS)), rng.random((2, INPUTS))])
    return [np.clip(lower + s * (upper - lower), lower, upper) for s in shares]


def _value(graph: ClaimGraph, point: np.ndarray) -> tuple[flint.arb, flint.arb]:
    with flint.ctx.workprec(200):
        box = {(0, i): ball_intervals.interval(x, x) for i, x in enumerate(point)}
        known = boxes.values(graph, ball_intervals, box)
        last = boxes.result(graph, 0, 0)
        value = known[last] if last is not None else ball_intervals.constant(0.0)
        return value[0].lower(), value[1].upper()


def _in_checker(
    graph: ClaimGraph,
    lower: np.ndarray,
    upper: np.ndarray,
    low: flint.arb,
    high: flint.arb,
) -> bool:
    """Whether the checker's own enclosure holds the value (or says nothing)."""
    box = {
        (0, i): intervals.interval(lower[i : i + 1], upper[i : i + 1])
        for i in range(INPUTS)
    }
    with np.errstate(all="ignore"):
        known = boxes.values(graph, intervals, box)
    last = boxes.result(graph, 0, 0)
    value = known[last] if last is not None else intervals.constant(0.0)
    a, b = float(intervals.lower(value)[0]), float(intervals.upper(value)[0])
    return not (a > high or b < low)
