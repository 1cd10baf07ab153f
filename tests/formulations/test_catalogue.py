"""Laws that every exported scheme must keep; a new one is tested by its export.

Each scheme is also built with what its signature offers: contacts with
spheres of the robot, and the pose task.
"""

import inspect

import casadi as ca
import numpy as np
import pytest
import qpsolvers

from rrnn_opt import formulations
from rrnn_opt.errors import RrnnError
from rrnn_opt.networks import PrimalDual
from rrnn_opt.symbolic import Tape
from rrnn_opt.symbolic.qp import FIELDS
from tests.catalogue import ROBOTS, Scheme, kinematics
from tests.catalogue import form as once
from tests.formulations.points import parameters

KNOWN = {
    *("q", "qd", "rd", "rd_dot", "rd_ddot", "error", "e_int", "q_start", "lam"),
    *("normals", "clearances", "magnitudes"),
    *("attraction", "bounds", "steering_margin", "radius"),  # of the planner's step
}


def variants():
    made = []
    for name in formulations.__all__:
        offered = inspect.signature(getattr(formulations, name)).parameters
        made.append((name, ""))
        made += [(name, option) for option in ("contacts", "task") if option in offered]
    return made


@pytest.fixture(scope="module", params=variants(), ids=":".join)
def variant(request):
    return request.param


@pytest.fixture(scope="module", params=ROBOTS)
def kin(request):
    return kinematics(request.param)


@pytest.fixture(scope="module")
def form(variant, kin):
    return once(kin.robot.name, Scheme(*variant))


def optimum(problem):
    best = qpsolvers.solve_problem(problem, solver="daqp", primal_tol=1e-10)
    assert best.found
    return best


def test_declared_for_this_robot(variant, form, kin):
    nv, names = kin.robot.nv, [s.name for s in form.parameters]
    assert form.name == variant[0]
    assert form.decision.name == "u"
    assert form.decision.size >= nv
    assert form.parameters[0].name == "q"
    assert set(names) <= KNOWN
    assert ("qd" in names) == (form.level == "acceleration")
    assert form.citation
    assert all(s.meaning and s.unit for s in (form.decision, *form.parameters))
    again = Scheme(*variant).build(kin.robot.name)
    assert form.fingerprint == again.fingerprint


def test_contacts_come_with_their_parameters(variant, form):
    names = {s.name for s in form.parameters}
    if variant[1] == "contacts":
        assert {"normals", "clearances"} <= names
    elif variant[0] != "slide":
        assert not {"normals", "clearances", "magnitudes"} & names


@pytest.mark.parametrize("index", [99, -1])
def test_a_contact_with_no_such_sphere_is_refused(variant, index):
    if variant[1] == "contacts" or variant[0] == "slide":
        scheme = getattr(formulations, variant[0])
        with pytest.raises(RrnnError, match=f"no sphere {index}"):
            scheme(kinematics("planar3"), contacts=(index,))


def test_a_convex_programme_whose_optimum_is_the_networks_equilibrium(form, kin):
    residual = PrimalDual()(form).functions()["residual"]
    for seed in range(3):
        given = parameters(form, kin, seed)
        problem = form.qp.at(**given)
        assert np.linalg.eigvalsh(problem.P)[0] >= 0
        best = optimum(problem)
        parts = [best.x]
        parts += [-best.y] if problem.A is not None else []
        parts += [best.z] if problem.G is not None else []
        inputs = [np.concatenate(parts), *(given[s.name] for s in form.parameters)]
        assert np.abs(np.asarray(residual(*inputs))).max() < 1e-7


def test_a_definite_hessian_so_that_every_network_may_try(form):
    assert np.linalg.eigvalsh(form.qp.hessian)[0] > 0


def test_gradient_of_the_lagrangian_against_finite_differences(form, kin):
    law = form.lagrangian
    symbols = [s.sx for s in (*law.symbols, *law.qp.parameters)]
    L = ca.Function("L", symbols, [law.expression, law.gradient])
    rng = np.random.default_rng(5)
    duals = [rng.uniform(size=s.shape) for s in law.symbols[1:]]
    given = parameters(form, kin, 5)
    rest = [*duals, *(given[s.name] for s in law.qp.parameters)]
    u = rng.normal(size=form.decision.size)
    gradient = np.asarray(L(u, *rest)[1]).ravel()
    for i, step in enumerate(1e-5 * np.eye(form.decision.size)):
        rise = float(L(u + step, *rest)[0] - L(u - step, *rest)[0])
        assert rise / 2e-5 == pytest.approx(gradient[i], rel=1e-6, abs=1e-6)


def test_an_inverse_is_declared_and_nothing_else_divides(variant, form):
    """A division by a value of the parameters is the mark of an inverse."""
    tape = Tape.of(form.qp.functions()["qp"])
    constant = {i for i, s in enumerate(tape.instructions) if s.op == "const"}
    divides = any(
        step.op in ("div", "inv") and not set(step.args[-1:]) <= constant
        for step in tape.instructions
    )
    scalar = variant[0] == "manipulability"  # by w + floor, a number
    assert divides == (bool(form.inverse) or scalar)


def test_no_number_of_the_programme_is_undefined_in_a_stretched_arm(form, kin):
    given = parameters(form, kin, 0) | {"q": np.zeros(kin.robot.nv)}
    values = form.qp.functions()["qp"](*(given[s.name] for s in form.parameters))
    for name, value in zip(FIELDS, values, strict=True):
        assert not np.isnan(np.asarray(value)).any(), name
