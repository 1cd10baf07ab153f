import casadi as ca
import numpy as np
import pytest

from rrnn_opt.formulations import classical, minimum_velocity
from rrnn_opt.formulations.classical import multiplier_rate
from rrnn_opt.networks import PrimalDual
from tests.formulations.points import bounds10, jacobian, parameters, posture, tip

EPSILON = 0.05


def test_it_is_network_6_taken_apart(every):
    """(6) of minimum_velocity = (6a) of classical + the integrated multiplier."""
    whole = PrimalDual(EPSILON)(minimum_velocity(every)).functions()["derivative"]
    part = PrimalDual(EPSILON)(classical(every)).functions()["derivative"]
    rng, nv = np.random.default_rng(0), every.robot.nv
    for _ in range(5):
        q, u, lam = posture(every, rng), rng.normal(size=nv), rng.normal(size=3)
        rate = rng.normal(size=3)
        both = np.asarray(whole(np.concatenate([u, lam]), q, rate)).ravel()
        J = ca.SX(jacobian(every, q))
        turned = ca.DM(multiplier_rate(J, ca.SX(u), ca.SX(rate), EPSILON))
        np.testing.assert_allclose(both[:nv], np.asarray(part(u, q, lam)).ravel())
        np.testing.assert_allclose(both[nv:], np.asarray(turned).ravel(), rtol=1e-12)


def test_the_optimum_is_the_projected_multiplier(pa10):
    form = classical(pa10)
    given = parameters(form, pa10, 0) | {"lam": np.array([0.4, -3.0, 0.2])}
    problem = form.qp.at(**given)
    low, high = bounds10(pa10, given["q"])
    push = jacobian(pa10, given["q"]).T @ given["lam"]
    np.testing.assert_allclose(-problem.q, push, atol=1e-14)
    np.testing.assert_allclose(problem.lb, low)
    np.testing.assert_allclose(problem.ub, high)
    np.testing.assert_array_equal(problem.P, np.eye(7))


def drift(kin, *, measured):
    """|e| after 4 s and after 8 s at rest, a joint creeping by 0.02 rad/s."""
    form, h, creep = classical(kin), 0.005, np.array([0.02, 0.0, 0.0])
    f = form.qp.functions()["qp"]
    J_of, position = kin.functions()["jacobian"], kin.functions()["position"]
    q, lam, errors = np.array([0.3, 0.8, -0.5]), np.zeros(3), []
    goal = tip(kin, q)
    for _ in range(1600):
        _, pull, *_, low, high = f(q, lam)
        u = np.clip(-np.asarray(pull), np.asarray(low), np.asarray(high)).ravel()
        done = u + creep
        J = np.asarray(J_of(q))
        known = done if measured else u
        rate = multiplier_rate(ca.SX(J), ca.SX(known), ca.SX.zeros(3), EPSILON)
        lam = lam + h * np.asarray(ca.DM(rate)).ravel()
        q = q + h * done
        errors.append(np.linalg.norm(goal - np.asarray(position(q)).ravel()))
    return errors[799], errors[1599]


@pytest.mark.slow
def test_unseen_motion_accumulates_when_commands_are_integrated(planar3):
    half, full = drift(planar3, measured=False)
    assert full > 1.8 * half > 0.05
    half, full = drift(planar3, measured=True)
    assert full < 1.05 * half < 0.01
