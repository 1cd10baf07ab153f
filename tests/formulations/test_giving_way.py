"""Tasks that cannot be done, tasks in order, and accelerations."""

import casadi as ca
import numpy as np
import pytest

from rrnn_opt.formulations import (
    damped_least_squares,
    minimum_acceleration,
    minimum_velocity,
    prioritised_tasks,
    slack_task,
)
from rrnn_opt.formulations.manipulability import gram_determinant
from tests.formulations.points import (
    jacobian,
    parameters,
    roomy,
    solve,
    tip,
)


def damped(J, rate, square):
    """J'(J J' + square I)^-1 rate."""
    return J.T @ np.linalg.solve(J @ J.T + np.diag(square), rate)


def test_slack_is_damping_while_there_is_room(every):
    form = slack_task(every, delta=0.03)
    given = roomy(form, every, 5)
    J = jacobian(every, given["q"])
    u = damped(J, given["rd_dot"], np.full(3, 0.03**2))
    x = solve(form, given)
    np.testing.assert_allclose(x[: every.robot.nv], u, atol=1e-8)
    missed = given["rd_dot"] - J @ u
    np.testing.assert_allclose(0.03 * x[every.robot.nv :], missed, atol=1e-8)


def test_slack_of_a_pose_has_two_scales(pa10):
    form = slack_task(pa10, task="pose", delta=0.03, delta_angular=0.2)
    given = roomy(form, pa10, 6)
    J = jacobian(pa10, given["q"], "pose")
    square = np.array([0.03**2] * 3 + [0.04] * 3)
    x = solve(form, given)
    np.testing.assert_allclose(x[:7], damped(J, given["rd_dot"], square), atol=1e-8)


def test_slack_gives_way_where_the_hard_task_has_no_solution(every):
    hard, soft = minimum_velocity(every), slack_task(every)
    given = parameters(hard, every, 7)
    given["rd_dot"] = 100 * jacobian(every, given["q"]) @ np.ones(every.robot.nv)
    with pytest.raises(AssertionError):
        solve(hard, given)
    p, x = soft.qp.at(**given), solve(soft, given)
    assert np.all((p.lb - 1e-9 <= x) & (x <= p.ub + 1e-9))
    assert x[: every.robot.nv] @ jacobian(every, given["q"]).T @ given["rd_dot"] > 0


def near_singular(kin, seed, bend):
    """Arm nearly stretched: every angle small."""
    rng = np.random.default_rng(seed)
    q = bend * rng.uniform(0.5, 1.0, kin.robot.nv)
    return {"q": q, "rd_dot": np.array([0.02, -0.01, 0.0])}


@pytest.mark.parametrize("name", ["planar3", "pa10"])
@pytest.mark.parametrize("bend", [0.0, 1e-3, 0.02])
def test_damping_near_a_singular_posture(arms, name, bend):
    kin = arms[name]
    form = damped_least_squares(kin, damping=0.1, threshold=0.05)
    given = near_singular(kin, 8, bend)
    J = jacobian(kin, given["q"])
    rows = J[:2] if name == "planar3" else J
    w = np.sqrt(max(np.linalg.det(rows @ rows.T), 0.0))
    delta = 0.1 * max(1 - w / 0.05, 0)
    assert delta > 0
    u = solve(form, given)[: kin.robot.nv]
    want = damped(J, given["rd_dot"], np.full(3, delta**2))
    np.testing.assert_allclose(u, want, atol=1e-7)
    assert np.linalg.norm(u) <= np.linalg.norm(given["rd_dot"]) / (2 * delta) + 1e-9


def test_no_damping_far_from_singular_postures(pa10):
    form = damped_least_squares(pa10, threshold=0.02)
    given = roomy(form, pa10, 9, q=np.array([0.1, 0.5, 0.2, 1.2, 0.3, 0.9, 0.0]))
    given["rd_dot"] = np.array([0.02, 0.01, -0.03])
    J = jacobian(pa10, given["q"])
    assert np.sqrt(np.linalg.det(J @ J.T)) > 0.02
    x = solve(form, given)
    np.testing.assert_allclose(x[:7], np.linalg.pinv(J) @ given["rd_dot"], atol=1e-9)
    assert form.qp.at(**given).lb is None


# priorities


@pytest.mark.parametrize("name", ["planar3", "pa10", "panda", "raven2"])
def test_two_levels_against_the_null_space_formula(arms, name):
    kin, ridge = arms[name], 1e-3
    form, nv = prioritised_tasks(kin, ridge=ridge), kin.robot.nv
    given = roomy(form, kin, 10)
    given["rd_dot"][3:] += [0.01, -0.02, 0.015]  # not always possible
    J = jacobian(kin, given["q"], "pose")
    Jv, Jw, v, w = J[:3], J[3:], given["rd_dot"][:3], given["rd_dot"][3:]
    first = np.linalg.pinv(Jv)
    N = np.eye(nv) - first @ Jv
    K = Jw @ N
    inner = np.linalg.solve(K @ K.T + ridge * np.eye(3), w - Jw @ first @ v)
    u = first @ v + K.T @ inner
    x, p = solve(form, given), form.qp.at(**given)
    assert np.all((p.lb[:nv] < u) & (u < p.ub[:nv]))
    np.testing.assert_allclose(x[:nv], u, atol=1e-7)
    np.testing.assert_allclose(x[nv:], w - Jw @ u, atol=1e-7)


def test_as_the_ridge_vanishes_the_order_is_lexicographic(arms):
    kin = arms["raven2"]  # six joints, of which the pose cannot have all it asks
    J = None
    misses = []
    for ridge in (1e-2, 1e-4, 1e-6):
        form = prioritised_tasks(kin, ridge=ridge)
        given = roomy(form, kin, 11)
        given["rd_dot"][3:] += [0.02, -0.02, 0.02]
        J = jacobian(kin, given["q"], "pose")
        u = solve(form, given)[:6]
        np.testing.assert_allclose(J[:3] @ u, given["rd_dot"][:3], atol=1e-9)
        misses.append(np.linalg.norm(given["rd_dot"][3:] - J[3:] @ u))
    first = np.linalg.pinv(J[:3])
    K = J[3:] @ (np.eye(6) - first @ J[:3])
    rest = given["rd_dot"][3:] - J[3:] @ first @ given["rd_dot"][:3]
    best = np.linalg.norm(rest - K @ np.linalg.pinv(K, rcond=1e-9) @ rest)
    assert misses[0] >= misses[1] >= misses[2] >= best - 1e-9
    assert misses[2] == pytest.approx(best, abs=1e-4)


# accelerations


def test_the_error_obeys_its_second_order_law(every):
    kappa, h = 6.0, 1e-3
    form = minimum_acceleration(every, kappa=kappa)
    given = roomy(form, every, 12)
    given["qd"] = 0.02 * every.robot.limits.velocity
    J, q, qd = jacobian(every, given["q"]), given["q"], given["qd"]
    given["rd"] = tip(every, q) + 0.0005 * J @ np.ones(every.robot.nv)
    given["rd_dot"] = J @ qd * 0.9
    f = ca.Function("f", [every.q], [every.position()])
    u = solve(form, given)
    path = [np.asarray(f(q + t * qd + t * t / 2 * u)).ravel() for t in (-h, 0, h)]
    velocity = (path[2] - path[0]) / (2 * h)
    second = (path[2] - 2 * path[1] + path[0]) / h**2
    error, rate = given["rd"] - path[1], given["rd_dot"] - velocity
    left = given["rd_ddot"] - second + 2 * kappa * rate + kappa**2 * error
    np.testing.assert_allclose(left, 0.0, atol=1e-5)
    assert np.linalg.norm(second) > 1e-3


def test_of_all_accelerations_it_takes_the_smallest(pa10):
    form = minimum_acceleration(pa10)
    given = roomy(form, pa10, 13)
    p, u = form.qp.at(**given), solve(form, given)
    np.testing.assert_allclose(u, np.linalg.pinv(p.A) @ p.b, atol=1e-8)
    limits, q, qd = pa10.robot.limits, given["q"], given["qd"]
    w = limits.acceleration / limits.velocity
    spring = w * w * (limits.upper - q) - 2 * w * qd
    high = [spring, 20 * (limits.velocity - qd), limits.acceleration]
    np.testing.assert_allclose(p.ub, np.minimum.reduce(high))


def test_a_determinant_that_rounds_below_zero_still_means_full_damping(planar3):
    q = np.array([1.8951213247291925, 0.0, 0.0])
    square = ca.Function("w2", [planar3.q], [gram_determinant(planar3)])(q)
    assert float(square) < 0.0
    form = damped_least_squares(planar3, damping=0.1, threshold=0.05)
    given = {"q": q, "rd_dot": np.array([0.02, -0.01, 0.0])}
    want = damped(jacobian(planar3, q), given["rd_dot"], np.full(3, 0.01))
    np.testing.assert_allclose(solve(form, given)[:3], want, atol=1e-9)
