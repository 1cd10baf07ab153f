"""The controller that every code computes, and where it is measured.

Seven joints (Panda), a position task, limits (10), and two control points against
one ball:

    minimise 1/2 u'u   subject to   J u = rd,   lb(q) <= u <= ub(q),
    -n_i'J_i u <= gamma (d_i - d_safe)   for sphere i of link 3 and of link 4.

A network step is kinematics, rows, limits, one Euler step of ``LviPdnn`` and its
merit V = 1/2 |residual|^2.  A solver is given J, b, rows and limits by code emitted
in the same way; that code is counted for it as the kinematics are for the network.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import casadi as ca
import numpy as np
import qpsolvers

import rrnn_opt as rr
from rrnn_opt.dynamics import Euler
from rrnn_opt.formulations.contacts import centre_jacobian
from rrnn_opt.formulations.limits import velocity_bounds
from rrnn_opt.symbolic import Symbol

SPHERES = (12, 16)
GAMMA, SAFE = 5.0, 0.02
RATE = 100.0
STEPS = {False: 0.3 / RATE, True: 0.3 / RATE}
"""Euler step, s, of the plain and of the whitened network."""
CASES = 24
FAR = 1e3
"""Stands for no bound in the solvers' data, m/s."""


@dataclass(frozen=True, eq=False)
class Case:
    """Joint angles, tip velocity and ball, and the optimum there."""

    q: np.ndarray
    rd: np.ndarray
    ball: np.ndarray
    best: np.ndarray
    bounds: int
    rows: int

    @property
    def request(self) -> np.ndarray:
        return np.concatenate([self.q, self.rd, self.ball])


@cache
def formulation() -> rr.Formulation:
    kin = rr.Kinematics(rr.Robot.builtin("panda"))
    u = Symbol.vector("u", 7, "rad/s", "joint velocity")
    q = Symbol("q", kin.q, "rad", "joint positions")
    rd = Symbol.vector("rd_dot", 3, "m/s", "tip velocity")
    ball = Symbol.vector("ball", 4, "m", "centre and radius")
    lower, upper = velocity_bounds(kin.q, kin.robot.limits)
    rows = []
    for index in SPHERES:
        gap = kin.sphere_centres()[:, index] - ball.sx[:3]
        length = ca.norm_2(gap)
        free = length - ball.sx[3] - float(kin.robot.spheres[index].radius) - SAFE
        rows.append(
            -((gap / length).T @ centre_jacobian(kin, index)) @ u.sx - GAMMA * free
        )
    return rr.Formulation(
        "budget",
        u,
        (q, rd, ball),
        ca.dot(u.sx, u.sx) / 2,
        equalities=rd.sx - kin.jacobian() @ u.sx,
        inequalities=ca.vertcat(*rows),
        lower=lower,
        upper=upper,
    )


def network(whiten: bool) -> rr.NeuralDynamics:
    return rr.networks.LviPdnn(gamma=RATE, whiten=whiten)(formulation())


def step(whiten: bool) -> ca.Function:
    """State, parameters and h to the next state and V."""
    h = Symbol.scalar("h", "s")
    law = network(whiten).step(Euler(h))
    symbols = [law.state, *law.parameters]
    merit = ca.sumsqr(law.residual) / 2
    return ca.Function(
        "arm_step",
        [s.sx for s in symbols],
        [ca.densify(law.next), merit],
        [s.name for s in symbols],
        ["next", "V"],
    )


def rows_first() -> ca.Function:
    """For DAQP: rows J and -n'J one after the other; limits of u, J u and rows."""
    qp = formulation().qp
    stacked = ca.vertcat(qp.A, qp.G)
    lower = ca.vertcat(qp.lb, qp.b, -FAR * ca.SX.ones(2))
    upper = ca.vertcat(qp.ub, qp.b, qp.h)
    return _data(ca.vec(stacked.T), lower, upper)


def columns_first() -> ca.Function:
    """For OSQP: values of the sparse [J; I; -n'J] by columns, and its limits."""
    qp = formulation().qp
    lower = ca.vertcat(qp.b, qp.lb, -FAR * ca.SX.ones(2))
    upper = ca.vertcat(qp.b, qp.ub, qp.h)
    return _data(ca.vertcat(*stacked_rows().nonzeros()), lower, upper)


def stacked_rows() -> ca.SX:
    """[J; I; -n'J], sparse."""
    qp = formulation().qp
    return ca.sparsify(ca.vertcat(qp.A, ca.SX.eye(7), qp.G))


def _data(values: ca.SX, lower: ca.SX, upper: ca.SX) -> ca.Function:
    symbols = formulation().parameters
    outputs = [ca.densify(x) for x in (values, lower, upper)]
    names = ["values", "lower", "upper"]
    inputs = [s.sx for s in symbols]
    return ca.Function("arm_data", inputs, outputs, [s.name for s in symbols], names)


@cache
def cases() -> tuple[Case, ...]:
    """Seeded arguments with an answer, limits and rows active in some."""
    rng = np.random.default_rng(5)
    kin = rr.Kinematics(rr.Robot.builtin("panda"))
    limits = kin.robot.limits
    centre = ca.Function("centre", [kin.q], [kin.sphere_centres()[:, SPHERES[1]]])
    found: list[Case] = []
    while len(found) < CASES:
        q = rng.uniform(0.9 * limits.lower, 0.9 * limits.upper)
        rd = 0.4 * rng.standard_normal(3)
        away = rng.standard_normal(3)
        place = np.asarray(centre(q)).ravel() + 0.25 * away / np.linalg.norm(away)
        case = _case(q, rd, np.append(place, 0.08))
        if case is not None:
            found.append(case)
    return tuple(found)


def _case(q: np.ndarray, rd: np.ndarray, ball: np.ndarray) -> Case | None:
    problem = formulation().qp.at(q=q, rd_dot=rd, ball=ball)
    if np.linalg.svd(problem.A, compute_uv=False)[-1] < 0.05:
        return None
    best = qpsolvers.solve_problem(problem, solver="daqp")
    if not best.found:
        return None
    near = np.minimum(best.x - problem.lb, problem.ub - best.x) < 1e-6
    tight = problem.h - problem.G @ best.x < 1e-6
    return Case(q, rd, ball, best.x, int(near.sum()), int(tight.sum()))
