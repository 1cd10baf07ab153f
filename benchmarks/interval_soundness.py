"""Random graphs, boxes and points: no value may lie outside its enclosure.

``python -m benchmarks.interval_soundness [--cases N]`` goes on from the number
of cases in ``results/interval_soundness.json``.  A case is one random graph
over one random box: its natural and mean-value enclosures by the compiled
kernel, the enclosures of the checker, and the value at a few points of the box
in ball arithmetic of 200 bits, which must overlap every one of them.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path

import casadi as ca
import flint
import numpy as np

from benchmarks.interval_graphs import random_box, random_graph
from rrnn_opt.check.arithmetic import ball_intervals, intervals
from rrnn_opt.check.claims.document import ClaimGraph, read_claim
from rrnn_opt.check.claims.graph import boxes
from rrnn_opt.claim import Claim, Relation
from rrnn_opt.errors import UnsupportedOperationError
from rrnn_opt.report import write_text
from rrnn_opt.symbolic import Symbol
from rrnn_opt.validation.ending import ended
from rrnn_opt.verification.document import claim_block
from rrnn_opt.verification.engines.interval.forms import Forms

RESULT = Path(__file__).parent / "results" / "interval_soundness.json"
INPUTS, GRAPHS, BOXES = 3, 10, 100
CASES = GRAPHS * BOXES


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cases", type=int, default=100_000)
    wanted = parser.parse_args().cases
    known = json.loads(RESULT.read_text()) if RESULT.exists() else {}
    cases, outside = known.get("cases", 0), known.get("outside", 0)
    bounded, seconds = known.get("bounded", 0), known.get("cpu_s", 0.0)
    while cases < wanted:
        begin = time.process_time()
        found = batch(cases // CASES)
        cases, outside = cases + CASES, outside + found[0]
        bounded, seconds = bounded + found[1], seconds + time.process_time() - begin
        row = {"cases": cases, "outside": outside, "bounded": bounded, "cpu_s": seconds}
        write_text(RESULT, json.dumps(row, indent=1) + "\n")
    print(RESULT.read_text())
    return 1 if outside else 0


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


if __name__ == "__main__":
    sys.exit(ended(main))
