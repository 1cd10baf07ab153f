"""Iterations to the optimum, with equality rows as declared and whitened.

Minimum velocity on the PA10 at seeded postures: 60 hard programmes (some bound
is active at the optimum, where the free joints' share of the rows is no longer
orthonormal) and 40 easy ones (none is).  Started at zero and counted until every
joint velocity is within 1e-4 rad/s of DAQP's optimum.  The networks have the
time constant 1 s here, so h is in units of it; "own step" is the one that
settling takes.  A programme that needs more than 20000 counts as 20000.  The
last column is plain over whitened.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import qpsolvers

import rrnn_opt as rr
from benchmarks.record import Benchmark, Row
from rrnn_opt import emit
from rrnn_opt.dynamics import Dynamics
from rrnn_opt.networks import DualNetwork, Hildreth, Lvi94, LviPdnn, PrimalDual
from rrnn_opt.networks.step_size import settling_step

NEAR, MOST = 1e-4, 20_000
HARD, EASY = 60, 40


@dataclass(frozen=True)
class Programme:
    """Parameters, optimum, and whether a bound is active there."""

    q: np.ndarray
    rd_dot: np.ndarray
    x: np.ndarray
    hard: bool


def programmes(kin: rr.Kinematics, form: rr.Formulation) -> Iterator[Programme]:
    """Feasible programmes at seeded postures, without end."""
    limits, rng = kin.robot.limits, np.random.default_rng(7)
    jacobian = kin.functions()["jacobian"]
    while True:
        share = rng.uniform(0.1, 0.9, kin.robot.nv)
        q = limits.lower + (limits.upper - limits.lower) * share
        velocity = rng.uniform(-1.5, 1.5, kin.robot.nv)
        rd_dot = np.asarray(jacobian(q)) @ velocity
        problem = form.qp.at(q=q, rd_dot=rd_dot)
        best = qpsolvers.solve_problem(problem, solver="daqp", primal_tol=1e-11)
        if best.found:
            room = np.minimum(best.x - problem.lb, problem.ub - best.x)
            yield Programme(q, rd_dot, best.x, bool(room.min() < 1e-7))


def chosen(kin: rr.Kinematics, form: rr.Formulation) -> dict[str, list[Programme]]:
    """60 hard and 40 easy ones."""
    found: dict[str, list[Programme]] = {"hard": [], "easy": []}
    for programme in programmes(kin, form):
        found["hard" if programme.hard else "easy"].append(programme)
        if len(found["hard"]) >= HARD and len(found["easy"]) >= EASY:
            break
    return {"hard": found["hard"][:HARD], "easy": found["easy"][:EASY]}


class Counter:
    """Counts the iterations of one network."""

    def __init__(self, law: Dynamics) -> None:
        self.law = law
        h = rr.Symbol.scalar("h", "s", "Euler step")
        step = law.step(rr.Euler(h)).functions()["step"]
        self._program = emit.compile(step)

    def count(self, programme: Programme, h: float | None) -> int:
        """Iterations until the output is near the optimum."""
        values = [programme.q, programme.rd_dot]
        state = np.zeros(self.law.state.size)
        size = settling_step(self.law, state, values) if h is None else h
        length = np.array([size])
        for k in range(MOST):
            state, u = self._program.call("step", state, *values, length)
            gap = np.abs(u.ravel() - programme.x).max()
            if gap < NEAR:
                return k
            if not gap < 1e9:
                break
        return MOST


def cases() -> Iterator[
    tuple[str, rr.networks.Network, rr.networks.Network, float | None]
]:
    """Name, plain, whitened, step."""
    for h in (0.5, None):
        step = "own step" if h is None else f"h = {h}"
        yield f"LviPdnn, {step}", LviPdnn(1.0), LviPdnn(1.0, whiten=True), h
        yield f"PrimalDual, {step}", PrimalDual(1.0), PrimalDual(1.0, whiten=True), h
    yield "DualNetwork, own step", DualNetwork(1.0), DualNetwork(1.0, whiten=True), None
    yield "Lvi94", Lvi94(), Lvi94(whiten=True), None
    yield "Hildreth", Hildreth(), Hildreth(whiten=True), None


def rows(kin: rr.Kinematics) -> Iterator[Row]:
    """Median, 90th percentile and largest count of every case."""
    form = rr.formulations.minimum_velocity(kin)
    found = chosen(kin, form)
    for name, plain, white, h in cases():
        counters = Counter(plain(form)), Counter(white(form))
        for kind, some in found.items():
            counts = [[c.count(p, h) for p in some] for c in counters]
            for label, q in (("median", 50), ("90 %", 90), ("largest", 100)):
                before, after = (float(np.percentile(c, q)) for c in counts)
                yield Row(f"{name}, {kind}, {label}: plain", before, "1")
                ratio = before / max(after, 1.0)
                yield Row(f"{name}, {kind}, {label}: whitened", after, "1", ratio)


def run(benchmark: Benchmark) -> None:
    benchmark.add(*rows(rr.Kinematics(rr.Robot.builtin("pa10"))))
