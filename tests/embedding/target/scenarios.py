"""What controllers meet: ticks along runs of the simulator, obstacles in the way."""

from dataclasses import dataclass
from functools import cache

import casadi as ca
import numpy as np
import qpsolvers

import rrnn_opt as rr
from rrnn_opt.errors import RrnnError
from rrnn_opt.scene import Scene, Sphere
from rrnn_opt.simulation import Control, Curve, Task
from rrnn_opt.simulation.obstacles import gaps

PERIOD = 0.01
START = np.array([0.0, -0.5, 0.0, -2.2, 0.0, 1.8, 0.7])
RUNS = (("yz", 0.12, 1.5), ("xy", 0.15, 1.2), ("zx", 0.10, 0.8), ("yz", 0.15, 0.7))
"""Plane and radius (m) of a circle, seconds a lap: fast ones press the limits."""
BALLS = (
    ((0.62, 0.20, 0.62), 0.06),
    ((0.55, -0.15, 0.55), 0.05),
    ((0.50, 0.00, 0.75), 0.07),
    ((0.55, 0.25, 0.55), 0.05),
)
"""Centre and radius, m: near the arm's way."""
CONTACTS = (31, 54)
"""Spheres of link 6 and of the hand."""


@dataclass(frozen=True, eq=False)
class Scenario:
    """One tick: what is told, the optimum there, how many constraints are active."""

    given: dict
    best: np.ndarray
    bounds: int
    rows: int


@cache
def arm():
    return rr.Kinematics(rr.Robot.builtin("panda"))


@cache
def scheme():
    return rr.formulations.slack_task(arm(), contacts=CONTACTS)


@cache
def scene():
    balls = enumerate(BALLS)
    return Scene(tuple(Sphere(f"ball{k}", r, np.array(c)) for k, (c, r) in balls))


@cache
def seen():
    clearance, normals = gaps(arm(), CONTACTS, scene())
    return ca.Function("seen", [arm().q], [clearance, normals])


@cache
def scenarios(count=200):
    """Ticks spread over the runs, in their order, each with a feasible programme."""
    found = [s for run in RUNS for s in _run(*run, count // len(RUNS))]
    assert len(found) == count
    return found


def _run(plane, radius, lap, count):
    curve = Curve("circle", lap, 1.2 * lap, "uniform", plane=plane, radius=radius)
    control = Control(dt=PERIOD, kappa=10.0)
    task = Task(curve, START, control=control, scene=scene(), contacts=CONTACTS)
    run = rr.simulate("slack_task", arm().robot, task)
    rate = np.gradient(run.reference, run.t, axis=0) + 10.0 * run.error
    rows = np.linspace(0, len(run.t) - 1, count).astype(int)
    return [_scenario(run.q[k], rate[k]) for k in rows]


def _scenario(q, rate):
    d, n = (np.asarray(x) for x in seen()(q))
    given = {"q": q, "rd_dot": rate, "normals": n, "clearances": d.ravel()}
    problem = scheme().qp.at(**given)
    best = qpsolvers.solve_problem(
        problem, solver="daqp", primal_tol=1e-10, dual_tol=1e-12
    )
    if not best.found:
        raise RrnnError("a scenario without an answer")
    x = best.x
    near = np.minimum(x - problem.lb, problem.ub - x) < 1e-7
    tight = problem.h - problem.G @ x < 1e-7
    return Scenario(given, x, int(near.sum()), int(tight.sum()))
