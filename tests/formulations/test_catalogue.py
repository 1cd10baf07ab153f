"""Laws that every exported scheme must keep; a new one is tested by its export."""

import casadi as ca
import numpy as np
import pytest
import qpsolvers

import rrnn_opt as rr
from rrnn_opt import formulations
from rrnn_opt.networks import PrimalDual

SCHEMES = formulations.__all__


@pytest.fixture(scope="module", params=SCHEMES)
def scheme(request):
    return getattr(formulations, request.param)


@pytest.fixture(scope="module", params=["planar3", "pa10"])
def kin(request):
    return rr.Kinematics(rr.Robot.builtin(request.param))


def values(form, kin, seed):
    """Small random parameters; joint positions inside the limits."""
    rng, limits = np.random.default_rng(seed), kin.robot.limits
    given = {s.name: rng.uniform(0.01, 0.05, s.shape) for s in form.parameters}
    for name in given.keys() & {"rd_dot"}:  # planar arms have no z
        given[name][2] = 0.0
    share = rng.uniform(0.3, 0.7, kin.robot.nv)
    return given | {"q": limits.lower + (limits.upper - limits.lower) * share}


def test_declared_for_this_robot(scheme, kin):
    form = scheme(kin)
    assert form.name == scheme.__name__
    assert form.decision.shape == (kin.robot.nv, 1)
    assert form.parameters[0].name == "q"
    assert form.citation
    assert all(s.meaning and s.unit for s in (form.decision, *form.parameters))
    assert form.fingerprint == scheme(kin).fingerprint


def test_a_convex_programme_whose_optimum_is_the_networks_equilibrium(scheme, kin):
    form = scheme(kin)
    dynamics = PrimalDual()(form)
    residual = dynamics.functions()["residual"]
    for seed in range(3):
        given = values(form, kin, seed)
        problem = form.qp.at(**given)
        assert np.linalg.eigvalsh(problem.P)[0] >= 0
        best = qpsolvers.solve_problem(problem, solver="daqp", primal_tol=1e-10)
        assert best.found
        parts = [best.x]
        parts += [-best.y] if problem.A is not None else []
        parts += [best.z] if problem.G is not None else []
        inputs = [np.concatenate(parts), *(given[s.name] for s in form.parameters)]
        assert np.abs(np.asarray(residual(*inputs))).max() < 1e-7


def test_gradient_of_the_lagrangian_against_finite_differences(scheme, kin):
    law = scheme(kin).lagrangian
    symbols = [s.sx for s in (*law.symbols, *law.qp.parameters)]
    L = ca.Function("L", symbols, [law.expression, law.gradient])
    rng = np.random.default_rng(5)
    duals = [rng.uniform(size=s.shape) for s in law.symbols[1:]]
    given = values(scheme(kin), kin, 5)
    rest = [*duals, *(given[s.name] for s in law.qp.parameters)]
    u = rng.normal(size=kin.robot.nv)
    gradient = np.asarray(L(u, *rest)[1]).ravel()
    for i, step in enumerate(1e-5 * np.eye(kin.robot.nv)):
        rise = float(L(u + step, *rest)[0] - L(u - step, *rest)[0])
        assert rise / 2e-5 == pytest.approx(gradient[i], rel=1e-6, abs=1e-6)
