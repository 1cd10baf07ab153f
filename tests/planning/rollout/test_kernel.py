"""One step of a rolled-out scheme is that of the declared one."""

import dataclasses

import casadi as ca
import numpy as np
import pytest
import qpsolvers

import rrnn_opt as rr
from rrnn_opt.formulations import joint_sign_sets
from rrnn_opt.formulations.signs import Band
from rrnn_opt.networks import PrimalDual
from rrnn_opt.planning import PaperRnn, Problem, SingleRollout
from tests.planning.rollout.planar import (
    LEVELS,
    SAFE,
    SECOND,
    at,
    contacts,
    document,
    forward,
    near_states,
    opened,
    states,
    tip,
)


@pytest.mark.parametrize("reading", ["transpose", "index"])
def test_a_step_is_eulers_of_the_declared_network(planar, rng, reading):
    """PrimalDual of joint_sign_sets is (17) with (10) and (12)."""
    target = np.array([0.6, 1.6, 0.0])
    settings = dataclasses.replace(SECOND, reading=reading)
    with opened(Problem.from_dict(document()), settings) as search:
        for q, u in near_states(rng, planar, 6):
            spheres, gaps, normals = contacts(planar, q)
            form = joint_sign_sets(
                forward()[0], contacts=spheres, reading=reading, safe=SAFE
            )
            dynamics = PrimalDual(settings.epsilon)(form)
            given = {"q": q, "rd": target, "normals": normals, "clearances": gaps}
            values = [given[p.name] for p in dynamics.parameters]
            rate = ca.Function(
                "rate",
                [dynamics.state.sx, *(p.sx for p in dynamics.parameters)],
                [dynamics.derivative],
            )
            wanted = u + settings.step * np.array(rate(u, *values)).ravel()
            after, error = search.velocity(q, u, target)
            np.testing.assert_allclose(after, wanted, atol=1e-10)
            assert error == pytest.approx(np.linalg.norm(target - tip(planar, q)))


def test_first_order_is_the_fixed_point_of_the_second(planar, rng):
    target = np.array([0.6, 1.6, 0.0])
    first = dataclasses.replace(SECOND, order="first")
    problem = Problem.from_dict(document())
    with opened(problem, first) as fast, opened(problem, SECOND) as slow:
        for q, u in states(rng, planar, 10):
            wanted, _ = fast.velocity(q, u, target)
            for _ in range(400):
                u, _ = slow.velocity(q, u, target)
            np.testing.assert_allclose(u, wanted, atol=1e-9)


@pytest.mark.parametrize("level", list(LEVELS))
def test_a_scheme_step_solves_the_declared_programme(planar, rng, level):
    """Swept to convergence; magnitudes are those stored in the same step."""
    settings = SingleRollout(
        level=level, sweeps=300_000, inner=0.05, outer=SAFE, contacts=16, rate=2.0
    )
    target, solved = np.array([0.6, 1.6, 0.0]), 0
    with opened(Problem.from_dict(document()), settings) as search:
        for q, u in near_states(rng, planar, 8):
            u = 0.1 * u
            answer = _declared(planar, settings, q, u, target)
            if answer is None:
                continue
            after, _ = search.velocity(q, u, target)
            if level == "acceleration":
                after = (after - u) / settings.step
            solved += 1
            np.testing.assert_allclose(after, answer, atol=2e-4)
    assert solved >= 2


def _declared(planar, settings, q, u, target):
    """Optimum of ``method1`` or ``method2``, or None where there is none."""
    spheres, gaps, normals = contacts(planar, q)
    kin, level = forward()[0], settings.level
    band = Band(settings.inner, settings.outer)
    form = LEVELS[level](kin, contacts=spheres, band=band)
    # a planar arm has no z: its row is left out
    error = target - tip(planar, q)
    length = np.linalg.norm(error)
    v = error * min(settings.gain, settings.speed / length)
    J = at("jacobian", q)
    given = {"q": q, "qd": u, "rd_dot": v, "normals": normals, "clearances": gaps}
    given["rd_ddot"] = settings.rate * (v - J @ u)
    rows = at("slopes", q).reshape(-1, 3, planar.nv)
    stored = [
        np.maximum(-np.sign(n) * (rows[i] @ u), 0)
        for i, n in zip(spheres, normals.T, strict=True)
    ]
    given["magnitudes"] = np.concatenate(stored or [np.zeros(0)])
    names = [p.name for p in form.parameters]
    try:
        qp = form.qp.at(**{name: given[name] for name in names})
    except rr.errors.RrnnError:
        return None
    A, b = qp.A[:2], qp.b[:2]
    small = qpsolvers.Problem(qp.P, qp.q, qp.G, qp.h, A, b, qp.lb, qp.ub)
    answer = qpsolvers.solve_problem(small, solver="daqp")
    return answer.x if answer.found else None


def test_sign_set_of_the_printed_indices_leads_into_the_obstacle(planar):
    """The stated counterexample: a planar arm along y with its obstacle at -x.

    n = (1, 0, 0) leaves the first joint [0, d+]; turning it forwards moves the
    tip along -x, into the obstacle.
    """
    settings = PaperRnn(order="first", reading="index", safe=0.3)
    wall = {"name": "wall", "type": "box", "size": [0.1, 6.0, 1.0]}
    data = document(
        start=[np.pi / 2, 0.0, 0.0],
        obstacles=[{**wall, "position": [-0.3, 0.0, 0.0]}],
    )
    target = np.array([-1.0, 2.0, 0.0])
    q = np.array(data["start"])
    with opened(Problem.from_dict(data), settings) as search:
        u, _ = search.velocity(q, np.zeros(3), target)
    J = at("jacobian", q)
    assert u[0] > 0.1
    assert (J @ u)[0] < -0.1
    transpose = dataclasses.replace(settings, reading="transpose")
    with opened(Problem.from_dict(data), transpose) as search:
        u, _ = search.velocity(q, np.zeros(3), target)
    assert np.max(u) <= 0.0
