import casadi as ca
import numpy as np
import pytest
import qpsolvers

import rrnn_opt as rr
from rrnn_opt.solving.parts import Dense
from rrnn_opt.validation.studies.catalogue import (
    contact_spheres,
    network_rules,
    schemes,
)
from rrnn_opt.validation.studies.points import KINDS, Points
from rrnn_opt.validation.studies.postures import Postures

ROBOTS = ("pa10", "panda", "raven2", "planar3")


@pytest.fixture(scope="module", params=ROBOTS)
def robot_kin(request):
    return rr.Kinematics(rr.Robot.builtin(request.param))


@pytest.fixture(scope="module")
def planar():
    return rr.Kinematics(rr.Robot.builtin("planar3"))


def test_every_exported_scheme_and_network_is_in_the_catalogue():
    names = {s.function for s in schemes()}
    assert names == set(rr.formulations.__all__)
    assert {"PrimalDual", "LviPdnn", "DualNetwork", "Znn"} <= set(network_rules())
    assert "MemoryCell" not in network_rules()
    poses = [s.name for s in schemes() if s.name.endswith("/pose")]
    assert "minimum_velocity/pose" in poses


def test_contact_spheres_move(robot_kin):
    spheres = contact_spheres(robot_kin)
    centres = ca.Function("c", [robot_kin.q], [robot_kin.sphere_centres()])
    q = Postures(robot_kin).inside(np.random.default_rng(0))
    apart = np.asarray(centres(q) - centres(q + 0.1))[:, spheres]
    assert (np.linalg.norm(apart, axis=0) > 5e-3).all()


def test_postures_are_where_they_should_be(robot_kin):
    postures, rng = Postures(robot_kin), np.random.default_rng(1)
    jacobian = ca.Function("J", [robot_kin.q], [robot_kin.jacobian()])
    wide = postures.upper - postures.lower

    def least(q):
        J = np.asarray(jacobian(q))
        return np.linalg.svd(J[np.any(J != 0.0, axis=1)])[1][-1]

    inside = [postures.inside(rng) for _ in range(20)]
    singular = [postures.near_singularity(rng) for _ in range(20)]
    edge = [postures.near_limits(rng) for _ in range(20)]
    for q in inside + singular + edge:
        assert (q >= postures.lower).all()
        assert (q <= postures.upper).all()
    share = np.minimum(edge - postures.lower, postures.upper - edge) / wide
    assert 0.3 < (share < 0.05).mean() < 0.7
    assert np.median([least(q) for q in singular]) < 0.05 * np.median(
        [least(q) for q in inside]
    )


@pytest.mark.parametrize("scheme", schemes(), ids=lambda s: s.name)
def test_points_are_feasible_and_of_the_kind_that_was_asked(scheme, planar):
    form = scheme.build(planar)
    source, rng = Points(form, planar), np.random.default_rng(3)
    for kind in KINDS:
        if kind == "contact" and not source.has_contacts:
            continue
        point = source.draw(kind, rng)
        assert point is not None
        assert point.kind == kind
        assert set(point.parameters) == {s.name for s in form.parameters}
        answer = qpsolvers.solve_problem(point.problem, solver="piqp")
        assert answer.found
        assert answer.primal_residual() < 1e-6
        if kind == "bounds" and form.qp.bounded:
            assert point.bound
        if kind == "contact":
            assert point.contact


def test_a_point_with_an_active_bound_has_one(planar):
    form = rr.formulations.minimum_velocity(planar)
    point = Points(form, planar).draw("bounds", np.random.default_rng(5))
    qp = Dense.of(point.problem)
    x = qpsolvers.solve_problem(point.problem, solver="quadprog").x
    assert np.minimum(x - qp.lb, qp.ub - x).min() < 1e-9


def test_an_obstacle_that_acts_changes_the_answer(planar):
    form = rr.formulations.clearance_rows(planar, contacts=contact_spheres(planar))
    point = Points(form, planar).draw("contact", np.random.default_rng(6))
    qp = Dense.of(point.problem)
    x = qpsolvers.solve_problem(point.problem, solver="quadprog").x
    assert (qp.h - qp.G @ x).min() < 1e-9
    free = np.clip(-qp.q, qp.lb, qp.ub)
    assert np.abs(free - x).max() > 1e-6


def test_the_same_seed_draws_the_same_points(planar):
    form = rr.formulations.minimum_velocity(planar)
    first, second = (
        Points(form, planar).draw("bounds", np.random.default_rng(9)) for _ in range(2)
    )
    np.testing.assert_array_equal(first.parameters["q"], second.parameters["q"])
    np.testing.assert_array_equal(
        first.parameters["rd_dot"], second.parameters["rd_dot"]
    )
