"""What is done with self-motion."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.optimize

import rrnn_opt as rr
from rrnn_opt.errors import RrnnError, ShapeError
from rrnn_opt.formulations import (
    infinity_norm,
    joint_limit_avoidance,
    manipulability,
    minimum_velocity,
    repetitive_motion,
)
from tests.formulations.points import (
    bounds10,
    data,
    jacobian,
    parameters,
    roomy,
    solve,
    tip,
)


def projected(J, rate, wish):
    """J# rate + (I - J# J) wish."""
    pinv = np.linalg.pinv(J)
    return pinv @ rate + wish - pinv @ (J @ wish)


def expect_wish(form, kin, given, wish, *, atol=1e-8):
    """The linear term is the wish, the optimum its projection; else as (3)."""
    plain = data(minimum_velocity(kin), {k: given[k] for k in ("q", "rd_dot")})
    ours = data(form, given)
    np.testing.assert_allclose(ours.pop("q"), -wish, rtol=1e-6, atol=atol)
    for name in ours:
        np.testing.assert_array_equal(ours[name], plain[name])
    u = projected(jacobian(kin, given["q"]), given["rd_dot"], wish)
    if np.all((ours["lb"] < u) & (u < ours["ub"])):
        np.testing.assert_allclose(solve(form, given), u, atol=1e-7)


def test_repetitive_motion_wishes_itself_back(every):
    form = repetitive_motion(every, gain=0.3)
    given = roomy(form, every, 1)
    expect_wish(form, every, given, -0.3 * (given["q"] - given["q_start"]))


def drift(kin, form, *, laps=3, steps=150):
    """How far the joints are from their start after circles of the tip."""
    start = np.array([0.0, 0.5, 0.0, 1.0, 0.0, 0.8, 0.0])
    q, h, home = start, 8.0 / steps, tip(kin, start)
    for k in range(laps * steps):
        a, b = 2 * np.pi * k / steps, 2 * np.pi * (k + 1) / steps
        rd = home + 0.1 * np.array([0.0, np.cos(b) - 1.0, np.sin(b)])
        on = home + 0.1 * np.array([0.0, np.cos(a) - 1.0, np.sin(a)])
        rate = (rd - on) / h + 5.0 * (on - tip(kin, q))
        given = {"q": q, "rd_dot": rate, "q_start": start}
        q = q + h * solve(form, {p.name: given[p.name] for p in form.parameters})
    return np.linalg.norm(q - start)


def test_closed_curves_bring_the_joints_back(pa10):
    free = drift(pa10, minimum_velocity(pa10))
    led = drift(pa10, repetitive_motion(pa10))
    assert led < free / 50


def test_joint_limit_avoidance_descends_its_potential(every):
    form = joint_limit_avoidance(every, gain=0.2)
    given, limits = roomy(form, every, 2), every.robot.limits
    middle, half = (limits.upper + limits.lower) / 2, (limits.upper - limits.lower) / 2

    def potential(q):
        return np.sum(((q - middle) / half) ** 2) / 2

    slope = scipy.optimize.approx_fprime(given["q"], potential, 1e-7)
    expect_wish(form, every, given, -0.2 * slope, atol=1e-5)


def test_a_joint_without_limits_has_no_wish():
    robot = rr.Robot.builtin("planar3")
    endless = replace(robot.limits, lower=np.array([-np.inf, -2.9, -2.9]))
    kin = rr.Kinematics(replace(robot, limits=endless))
    given = {"q": np.array([0.5, 0.5, 0.5]), "rd_dot": np.zeros(3)}
    pull = joint_limit_avoidance(kin).qp.at(**given).q
    assert pull[0] == 0.0
    assert pull[1] > 0.0


def test_manipulability_is_climbed(every):
    floor = 1e-3
    form = manipulability(every, gain=0.2, floor=floor)
    given = roomy(form, every, 3)
    rows = slice(0, 2 if every.robot.name == "planar3" else 3)

    def measure(q):
        J = jacobian(every, q)[rows]
        return np.sqrt(np.linalg.det(J @ J.T) + floor**2)

    slope = scipy.optimize.approx_fprime(given["q"], measure, 1e-7)
    expect_wish(form, every, given, 0.2 * slope, atol=1e-6)


# the largest speed


def least_largest(kin, given, sizes):
    """min max |u_j| / size_j as a linear programme, by HiGHS."""
    nv, J = kin.robot.nv, jacobian(kin, given["q"])
    low, high = bounds10(kin, given["q"])
    shares = np.hstack([np.diag(1 / sizes), -np.ones((nv, 1))])
    mirror = np.hstack([-np.diag(1 / sizes), -np.ones((nv, 1))])
    found = scipy.optimize.linprog(
        np.append(np.zeros(nv), 1.0),
        A_ub=np.vstack([shares, mirror]),
        b_ub=np.zeros(2 * nv),
        A_eq=np.hstack([J, np.zeros((3, 1))]),
        b_eq=given["rd_dot"],
        bounds=[*zip(low, high, strict=True), (None, None)],
    )
    assert found.success
    return found.fun


@pytest.mark.parametrize("scaled", [False, True])
def test_infinity_norm_against_a_linear_programme(every, scaled):
    sizes = every.robot.limits.velocity if scaled else np.ones(every.robot.nv)
    ridge = 1e-4
    form = infinity_norm(every, ridge=ridge, scale=sizes if scaled else None)
    for seed in range(3):
        given = parameters(form, every, seed)
        x = solve(form, given)
        u, t = x[:-1], x[-1]
        best = least_largest(every, given, sizes)
        assert np.max(np.abs(u) / sizes) == pytest.approx(t, abs=1e-9)
        assert best - 1e-9 <= t <= best * (1 + ridge * np.sum(sizes**2) / 2) + 1e-9
        J = jacobian(every, given["q"])
        np.testing.assert_allclose(J @ u, given["rd_dot"], atol=1e-9)


def test_infinity_norm_is_not_the_second_norm(pa10):
    form = infinity_norm(pa10)
    given = roomy(form, pa10, 4)
    x, u = solve(form, given), solve(minimum_velocity(pa10), given)
    assert x[-1] < 0.99 * np.abs(u).max()
    assert np.linalg.norm(x[:-1]) > np.linalg.norm(u)


@pytest.mark.parametrize(
    ("scale", "error"), [(np.ones(6), ShapeError), (np.zeros(7), RrnnError)]
)
def test_scales_are_checked(pa10, scale, error):
    with pytest.raises(error, match="scale"):
        infinity_norm(pa10, scale=scale)
