"""A small programme with every part, and its numbers in numpy."""

from functools import lru_cache

import casadi as ca
import numpy as np
import qpsolvers

from rrnn_opt.formulation import Formulation
from rrnn_opt.symbolic import Symbol

WEIGHT = np.array(
    [
        [2.0, 0.3, 0.0, 0.1],
        [0.3, 1.0, 0.2, 0.0],
        [0.0, 0.2, 0.8, 0.0],
        [0.1, 0.0, 0.0, 1.5],
    ]
)
IDENTITY = np.eye(4)
LINEAR = np.array([0.3, -0.2, 0.1, 0.4])
G = np.array([[1.0, -1.0, 0.5, 0.0], [0.0, 0.4, 1.0, -1.0]])
H = np.array([0.1, 0.3])
BOUND = 0.5


def programme(weight=WEIGHT, *, inequalities=True, bounds=True):
    """``min 1/2 u'Wu + c'u, A u = b, G u <= h, |u| <= 0.5``, A and b parameters."""
    u = Symbol.vector("u", 4)
    A, b = Symbol.matrix("A", (2, 4)), Symbol.vector("b", 2)
    cost = ca.bilin(ca.SX(ca.sparsify(ca.DM(weight))), u.sx, u.sx) / 2
    return Formulation(
        name="toy",
        decision=u,
        parameters=(A, b),
        cost=cost + ca.dot(ca.SX(LINEAR), u.sx),
        equalities=b.sx - A.sx @ u.sx,
        inequalities=ca.SX(G) @ u.sx - H if inequalities else None,
        lower=-BOUND * ca.SX.ones(4) if bounds else None,
        upper=BOUND * ca.SX.ones(4) if bounds else None,
    )


def point(seed, *, size=0.4):
    """A and b of a feasible programme."""
    rng = np.random.default_rng(seed)
    A = rng.normal(size=(2, 4))
    return {"A": A, "b": A @ rng.uniform(-size, size, 4)}


def optimum(form, given):
    """DAQP's answer, or None where there is no feasible point."""
    best = qpsolvers.solve_problem(
        form.qp.at(**given), solver="daqp", primal_tol=1e-11, dual_tol=1e-12
    )
    return best if best.found else None


def hand_matrix(weight, A, g=G):
    """H of the monotone map."""
    p, m = len(A), len(g)
    return np.block(
        [
            [weight, -A.T, g.T],
            [A, np.zeros((p, p + m))],
            [-g, np.zeros((m, p + m))],
        ]
    )


def hand_error(weight, given, y):
    """``y - P_Z(y - F(y))`` and F(y), for the programme with every part."""
    A, b = given["A"], given["b"]
    F = hand_matrix(weight, A) @ y + np.concatenate([LINEAR, -b, H])
    moved = y - F
    moved[:4] = np.clip(moved[:4], -BOUND, BOUND)
    moved[6:] = np.maximum(moved[6:], 0.0)
    return y - moved, F


def call(fn, *arrays):
    """First result of a CasADi function, flat."""
    return np.asarray(fn.call([*arrays])[0], dtype=float).ravel()


@lru_cache(maxsize=16)
def functions(dynamics):
    return dynamics.functions()


def law(dynamics, state, given):
    """Derivative, or next state."""
    made = functions(dynamics)
    fn = made["derivative" if "derivative" in made else "step"]
    return call(fn, state, *(given[p.name] for p in dynamics.parameters))


def values(dynamics, name, state, given):
    """Output, residual or the first multiplier."""
    inputs = [given[p.name] for p in dynamics.parameters]
    return call(functions(dynamics)[name], state, *inputs)
