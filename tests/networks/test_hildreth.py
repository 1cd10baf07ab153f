import ctypes
from importlib import resources

import casadi as ca
import numpy as np
import pytest

from rrnn_opt import emit
from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks import Hildreth
from rrnn_opt.symbolic import Symbol
from tests.networks.toy import (
    BOUND,
    IDENTITY,
    LINEAR,
    WEIGHT,
    G,
    H,
    law,
    optimum,
    point,
    programme,
    values,
)

_GLUE = """
RRNN_EXPORT void sweep(int n, int m, const real_t *rows, const real_t *h,
                       const real_t *lower, const real_t *upper, int sweeps,
                       real_t *lambda, real_t *z, real_t *u);
void sweep(int n, int m, const real_t *rows, const real_t *h,
           const real_t *lower, const real_t *upper, int sweeps,
           real_t *lambda, real_t *z, real_t *u)
{
    hildreth(n, m, rows, h, lower, upper, sweeps, lambda, z, u);
}
"""


@pytest.fixture(scope="module")
def sweep_in_c():
    """The sweep that the planner runs, as it is."""
    header = resources.files("rrnn_opt.emit") / "support" / "hildreth.h"
    source = "\n".join([emit.prologue(), header.read_text("utf-8"), _GLUE])
    entry = emit.load(emit.build(source, name="hildreth_test"))["sweep"]
    integer, pointer = ctypes.c_int, ctypes.c_void_p
    entry.argtypes = (integer, integer, *([pointer] * 4), integer, *([pointer] * 3))
    entry.restype = None
    return entry


def swept(sweep_in_c, sweeps, rows, h, w):
    """Multipliers of the rows, of the box, and the point after some sweeps in C."""
    lam, z, x = np.zeros(3), np.zeros(4), w.copy()
    given = (np.ascontiguousarray(rows), h, np.full(4, -BOUND), np.full(4, BOUND))
    pointers = [a.ctypes.data for a in given]
    sweep_in_c(4, 3, *pointers, sweeps, *(a.ctypes.data for a in (lam, z, x)))
    return lam, z, x


@pytest.mark.parametrize("sweeps", [1, 2, 25])
def test_it_is_the_sweep_of_the_planner(sweep_in_c, sweeps):
    """With w = -c, rows = -G, h = -h; row 2 is zero and must be left out."""
    u = Symbol.vector("u", 4)
    rows, h = Symbol.matrix("rows", (3, 4)), Symbol.vector("h", 3)
    w = Symbol.vector("w", 4)
    form = Formulation(
        "slide",
        u,
        (rows, h, w),
        cost=ca.dot(u.sx, u.sx) / 2 - ca.dot(w.sx, u.sx),
        inequalities=h.sx - rows.sx @ u.sx,
        lower=-BOUND * ca.SX.ones(4),
        upper=BOUND * ca.SX.ones(4),
    )
    dynamics, rng = Hildreth()(form), np.random.default_rng(sweeps)
    for _ in range(20):
        given = {"rows": rng.normal(size=(3, 4)), "h": rng.normal(size=3) / 2}
        given |= {"w": rng.normal(size=4)}
        given["rows"][2] = 0.0
        state = np.zeros(7)
        for _ in range(sweeps):
            state = law(dynamics, state, given)
        lam, z, x = swept(sweep_in_c, sweeps, **given)
        np.testing.assert_allclose(state, [*lam, *-z], atol=1e-12)
        np.testing.assert_allclose(
            values(dynamics, "output", state, given), x, atol=1e-12
        )
        assert lam[2] == 0.0


@pytest.mark.parametrize("weight", [IDENTITY, WEIGHT])
def test_each_neuron_solves_its_own_row(weight):
    """Gauss-Seidel on the dual in numpy, neuron by neuron."""
    dynamics, M = Hildreth()(programme(weight)), np.linalg.inv(weight)
    rng = np.random.default_rng(0)
    for seed in range(5):
        given, state = point(seed), rng.normal(size=8)
        C = np.vstack([given["A"], -G, -np.eye(4)])
        want = np.concatenate([given["b"], -H])
        dual = state.copy()
        for i in range(8):
            x = M @ (C.T @ dual - LINEAR)
            curvature = C[i] @ M @ C[i]
            if i < 4:
                dual[i] += (want[i] - C[i] @ x) / curvature
                dual[i] = dual[i] if i < 2 else max(dual[i], 0.0)
            else:
                free = x[i - 4] + curvature * dual[i]
                dual[i] = (free - np.clip(free, -BOUND, BOUND)) / curvature
        np.testing.assert_allclose(law(dynamics, state, given), dual, atol=1e-11)


def test_it_comes_to_rest_at_the_solvers_optimum():
    form = programme()
    dynamics = Hildreth()(form)
    checked = 0
    for seed in range(6):
        given = point(seed)
        best = optimum(form, given)
        if best is None:
            continue
        state = np.zeros(8)
        for _ in range(3000):
            state = law(dynamics, state, given)
        x = values(dynamics, "output", state, given)
        np.testing.assert_allclose(x, best.x, atol=1e-6)
        checked += 1
    assert checked >= 3


def test_a_singular_hessian_is_refused():
    with pytest.raises(RrnnError, match=r"Hildreth: toy .* not positive definite"):
        Hildreth()(programme(np.diag([1.0, 1.0, 1.0, 0.0])))
