"""Methods 1 to 3 and the other rows of Table I, against oracles of their own."""

import numpy as np
import pytest

from rrnn_opt.errors import RrnnError
from rrnn_opt.formulations import (
    closed_loop,
    method1,
    method2,
    method3,
    minimum_velocity,
    model35,
    model36,
    model43,
    position_feedback,
)
from rrnn_opt.formulations.signs import Band
from tests.formulations.points import (
    bounds10,
    centre,
    data,
    jacobian,
    jacobian_rate,
    parameters,
    roomy,
    solve,
    sphere_jacobian,
    tip,
)

BAND = Band(inner=0.02, outer=0.12)


def share(d):
    x = np.clip((d - BAND.inner) / (BAND.outer - BAND.inner), 0, 1)
    return np.sin(np.pi / 2 * x) ** 2


def spheres(kin):
    return (len(kin.robot.spheres) // 2, len(kin.robot.spheres) - 1)


# Method 1


def test_method1_rows_tighten_with_the_distance_and_end_beyond_the_band(every):
    chosen = spheres(every)
    form = method1(every, contacts=chosen, band=BAND)
    for seed, gaps in enumerate([(0.05, 0.01), (0.12, 0.13), (0.2, 0.08)]):
        given = parameters(form, every, seed) | {"clearances": np.array(gaps)}
        problem = form.qp.at(**given)
        for i, gap in enumerate(gaps):
            rows = slice(3 * i, 3 * i + 3)
            on = gap <= BAND.outer
            J = sphere_jacobian(every, chosen[i], given["q"])
            want = -np.sign(given["normals"][:, [i]]) * J * on
            np.testing.assert_allclose(problem.G[rows], want, atol=1e-8)
            allowed = on * share(gap) * given["magnitudes"][rows]
            np.testing.assert_allclose(problem.h[rows], allowed, atol=1e-15)


def test_method1_strict_allows_nothing_and_asks_for_nothing(every):
    form = method1(every, contacts=spheres(every), strict=True, band=BAND)
    names = [p.name for p in form.parameters]
    assert names == ["q", "rd_dot", "normals", "clearances"]
    given = parameters(form, every, 0) | {"clearances": np.array([0.05, 0.05])}
    variable = method1(every, contacts=spheres(every), band=BAND)
    loose = given | {"magnitudes": np.full(6, 0.1)}
    np.testing.assert_array_equal(form.qp.at(**given).h, 0.0)
    assert np.all(variable.qp.at(**loose).h > 0.0)
    np.testing.assert_array_equal(form.qp.at(**given).G, variable.qp.at(**loose).G)


def test_method1_without_obstacles_is_the_open_loop(every):
    given = parameters(method1(every), every, 1)
    ours, theirs = data(method1(every), given), data(minimum_velocity(every), given)
    for name, value in ours.items():
        np.testing.assert_array_equal(value, theirs[name])
    assert "rd" not in given  # nothing is fed back


# Method 2


def motion(given, u):
    """The joints along q + qd t + u t^2 / 2."""

    def posture(t):
        return given["q"] + t * given["qd"] + t * t / 2 * u

    return posture


def test_method2_equality_is_the_second_derivative_of_the_tip(every):
    form = method2(every)
    given = parameters(form, every, 2) | {"qd": 0.1 * every.robot.limits.velocity}
    J, q, qd = jacobian(every, given["q"]), given["q"], given["qd"]
    given["rd_ddot"] = jacobian_rate(every, q, qd) @ qd + 0.02 * J.sum(axis=1)
    u, h = solve(form, given), 1e-3
    at = motion(given, u)
    second = (tip(every, at(h)) - 2 * tip(every, at(0)) + tip(every, at(-h))) / h**2
    np.testing.assert_allclose(second, given["rd_ddot"], atol=1e-5)
    problem = form.qp.at(**given)
    np.testing.assert_array_equal(problem.P, np.eye(every.robot.nv))
    np.testing.assert_array_equal(problem.q, 0.0)


def test_method2_rows_are_the_sign_rows_and_their_derivative(every):
    sphere, kappa_o, h = spheres(every)[1], 8.0, 1e-5
    form = method2(every, contacts=(sphere,), band=BAND, kappa_o=kappa_o)
    rng = np.random.default_rng(3)
    given = parameters(form, every, 3)
    pace = every.robot.limits.velocity * rng.uniform(-0.5, 0.5, every.robot.nv)
    given |= {"clearances": np.array([0.07]), "qd": pace}
    u = rng.normal(size=every.robot.nv)
    at, n = motion(given, u), given["normals"].ravel()
    start = centre(every, sphere, given["q"])

    def excess(t):
        J = sphere_jacobian(every, sphere, at(t))
        gap = 0.07 + n @ (centre(every, sphere, at(t)) - start)
        towards = -np.sign(n) * (J @ (given["qd"] + t * u))
        return towards - share(gap) * given["magnitudes"]

    wanted = (excess(h) - excess(-h)) / (2 * h) + kappa_o * excess(0)
    problem = form.qp.at(**given)
    np.testing.assert_allclose(problem.G @ u - problem.h, wanted, atol=1e-4)
    far = form.qp.at(**given | {"clearances": np.array([0.13])})
    assert not far.G.any()
    assert not far.h.any()


def test_method2_keeps_all_three_limits_in_its_box(pa10):
    form = method2(pa10, mu_p=15.0, mu_v=9.0, range_share=0.0)
    given = parameters(form, pa10, 4)
    limits, q, qd = pa10.robot.limits, given["q"], given["qd"]
    high = [15 * (limits.upper - q), 9 * (limits.velocity - qd), limits.acceleration]
    problem = form.qp.at(**given)
    np.testing.assert_allclose(problem.ub, np.minimum.reduce(high))
    low = [15 * (limits.lower - q), 9 * (-limits.velocity - qd), -limits.acceleration]
    np.testing.assert_allclose(problem.lb, np.maximum.reduce(low))


# Method 3


def test_method3_has_three_terms_and_no_limits(every):
    form = method3(every, k0=11.0, k1=30.0)
    given = parameters(form, every, 5)
    problem = form.qp.at(**given)
    error = given["rd"] - tip(every, given["q"])
    asked = given["rd_dot"] + 11 * error + 30 * given["e_int"]
    np.testing.assert_allclose(problem.b, asked, atol=1e-14)
    assert problem.lb is None
    assert problem.G is None
    u = np.linalg.pinv(jacobian(every, given["q"])) @ asked
    np.testing.assert_allclose(solve(form, given), u, atol=1e-8)


def offset(kin, form, *, seconds=6.0, h=0.01):
    """|e| at the end, a joint creeping unseen while the target rests."""
    q, total = np.array([0.3, 0.8, -0.5]), np.zeros(3)
    goal, creep = tip(kin, q), np.array([0.05, 0.0, 0.0])
    for _ in range(round(seconds / h)):
        error = goal - tip(kin, q)
        given = {"q": q, "rd": goal, "rd_dot": np.zeros(3), "e_int": total}
        problem = form.qp.at(**{p.name: given[p.name] for p in form.parameters})
        q = q + h * (np.linalg.pinv(problem.A) @ problem.b + creep)
        total = total + h * error
    return np.linalg.norm(goal - tip(kin, q))


def test_the_integral_removes_what_proportional_feedback_leaves(planar3):
    assert offset(planar3, closed_loop(planar3, kappa=20.0)) > 1e-3
    assert offset(planar3, method3(planar3, k0=20.0, k1=100.0)) < 1e-6


# the other rows


def test_model35_is_the_closed_loop_under_the_tables_name(every):
    given = parameters(model35(every), every, 6)
    ours, theirs = data(model35(every), given), data(closed_loop(every), given)
    for name, value in ours.items():
        np.testing.assert_array_equal(value, theirs[name])
    fixed = data(model35(every, position_limits=False), given)
    np.testing.assert_array_equal(fixed["ub"], every.robot.limits.velocity)
    np.testing.assert_array_equal(fixed["lb"], -every.robot.limits.velocity)
    assert np.any(ours["ub"] != fixed["ub"])


def test_model36_clamps_the_speeds_and_nothing_else(every):
    form = model36(every, speed=0.25)
    given = parameters(form, every, 7)
    ours, theirs = data(form, given), data(position_feedback(every), given)
    low, high = bounds10(every, given["q"])
    most = 0.25 * every.robot.limits.velocity
    np.testing.assert_allclose(ours["ub"], np.minimum(high, most))
    np.testing.assert_allclose(ours["lb"], np.maximum(low, -most))
    np.testing.assert_array_equal(ours["q"], theirs["q"])
    np.testing.assert_array_equal(
        data(model36(every, speed=1.0), given)["ub"], theirs["ub"]
    )


@pytest.mark.parametrize("speed", [0.0, 1.1, np.nan])
def test_model36_takes_a_share(pa10, speed):
    with pytest.raises(RrnnError, match="share in"):
        model36(pa10, speed=speed)


def test_model43_is_slower_than_asked_by_what_its_damping_says(every):
    damping = 0.01
    form = model43(every, damping=damping)
    given = roomy(form, every, 8)
    J = jacobian(every, given["q"])
    gram = J @ J.T + damping * np.eye(3)
    u = solve(form, given)
    np.testing.assert_allclose(
        u, J.T @ np.linalg.solve(gram, given["rd_dot"]), atol=1e-9
    )
    missing = damping * np.linalg.solve(gram, given["rd_dot"])
    np.testing.assert_allclose(given["rd_dot"] - J @ u, missing, atol=1e-9)
    assert np.linalg.norm(missing) > 1e-6
    assert form.inverse == "J J' + damping I"
    assert form.qp.at(**given).lb is None
