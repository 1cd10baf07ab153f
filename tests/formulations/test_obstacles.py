"""What each way of avoiding an obstacle admits, and what it does not."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.errors import RrnnError
from rrnn_opt.formulations import (
    clearance_rows,
    gradient_projection,
    joint_sign_sets,
    method2,
    position_feedback,
    sign_rows,
    slack_task,
)
from tests.formulations.points import (
    bounds10,
    centre,
    data,
    parameters,
    posture,
    solve,
    sphere_jacobian,
    tip,
    unit_normals,
)

LAWS = settings(max_examples=40)
UPRIGHT = np.array([np.pi / 2, 0.0, 0.0])
LEFT_WALL = np.array([[1.0], [0.0], [0.0]])  # outward normal of a wall at the left


def last(kin):
    return len(kin.robot.spheres) - 1


def near(kin, seed, *, gap=0.01, k=1):
    """A posture with critical contacts of random normals."""
    rng = np.random.default_rng(seed)
    q = posture(kin, rng)
    gaps, n = np.full(k, gap), unit_normals(kin, rng, k)
    return {"q": q, "normals": n, "clearances": gaps}


def admits(form, given, u):
    """Whether u satisfies all bounds and rows."""
    p = form.qp.at(**given)
    inside = np.all((p.lb - 1e-12 <= u) & (u <= p.ub + 1e-12))
    return bool(inside and (p.G is None or np.all(p.G @ u <= p.h + 1e-12)))


# the witness of (12)


def upright(kin):
    goal = {"q": UPRIGHT, "rd": tip(kin, UPRIGHT)}
    return goal | {"normals": LEFT_WALL, "clearances": np.array([0.02])}


def test_index_sign_sets_admit_a_motion_into_the_obstacle(planar3):
    """Arm straight up, wall to the left: turning joint 1 forwards goes left."""
    sphere, into = last(planar3), np.array([1.0, 0.0, 0.0])
    approach = -LEFT_WALL.T @ sphere_jacobian(planar3, sphere, UPRIGHT) @ into
    assert approach > 2.0  # m/s, towards the wall
    given = upright(planar3)
    printed = joint_sign_sets(planar3, contacts=(sphere,), reading="index")
    assert admits(printed, given, 0.5 * into)
    for other in (
        clearance_rows(planar3, contacts=(sphere,), safe=0.02),
        sign_rows(planar3, contacts=(sphere,)),
        joint_sign_sets(planar3, contacts=(sphere,)),
    ):
        assert not admits(other, given, 0.5 * into), other.name
        assert admits(other, given, -0.5 * into), other.name


def rollout(kin, form, *, steps=150, h=0.01):
    """Least clearance of the tip's sphere on the way to a target in the wall."""
    sphere, q = last(kin), np.array([1.3, 0.3, 0.4])
    wall = centre(kin, sphere, q)[0] - kin.robot.spheres[sphere].radius - 0.1
    goal, least = tip(kin, q) - np.array([0.4, 0.0, 0.0]), np.inf
    for _ in range(steps):
        gap = centre(kin, sphere, q)[0] - kin.robot.spheres[sphere].radius - wall
        least = min(least, gap)
        given = {"q": q, "rd": goal, "normals": LEFT_WALL}
        q = q + h * solve(form, given | {"clearances": np.array([gap])})
    return least


def test_only_the_index_reading_goes_through_the_wall(planar3):
    chosen = {"contacts": (last(planar3),)}
    assert rollout(planar3, joint_sign_sets(planar3, reading="index", **chosen)) < -0.1
    assert rollout(planar3, joint_sign_sets(planar3, safe=0.05, **chosen)) > 0.0
    assert rollout(planar3, sign_rows(planar3, safe=0.05, **chosen)) > 0.0
    kept = rollout(planar3, clearance_rows(planar3, safe=0.02, **chosen))
    assert 0.015 < kept < 0.03  # it uses the room it has


# joint sign sets


def test_transpose_sign_sets_are_what_they_say(every):
    sphere = last(every)
    form = joint_sign_sets(every, contacts=(sphere,))
    for seed in range(5):
        given = near(every, seed) | {"rd": np.zeros(3)}
        low, high = bounds10(every, given["q"])
        J = sphere_jacobian(every, sphere, given["q"])
        push = (J.T @ given["normals"]).ravel()
        moves = np.abs(J).max(axis=0) > 1e-7
        clear = moves & (np.abs(push) > 1e-7)
        p = form.qp.at(**given)
        np.testing.assert_allclose(p.lb[clear], np.where(push > 0, 0, low)[clear])
        np.testing.assert_allclose(p.ub[clear], np.where(push < 0, 0, high)[clear])
        far = form.qp.at(**given | {"clearances": np.array([0.06])})
        np.testing.assert_allclose(far.lb, low)
        np.testing.assert_allclose(far.ub, high)


@pytest.fixture(scope="module")
def signed(pa10):
    """Sign sets and sign rows of the arm's last sphere."""
    chosen = {"contacts": (last(pa10),)}
    return joint_sign_sets(pa10, **chosen).qp, sign_rows(pa10, **chosen).qp


@LAWS
@given(st.integers(0, 999), st.lists(st.floats(0, 1), min_size=7, max_size=7))
def test_transpose_sets_and_sign_rows_admit_no_approach(pa10, signed, seed, share):
    given = near(pa10, seed) | {"rd": np.zeros(3)}
    box = signed[0].at(**given)
    u = box.lb + (box.ub - box.lb) * np.array(share)
    rate = given["normals"].T @ sphere_jacobian(pa10, last(pa10), given["q"])
    assert rate @ u >= -1e-7
    rows = signed[1].at(**given)
    if np.all(rows.G @ u <= rows.h):
        assert rate @ u >= -1e-7


def test_two_contacts_can_freeze_the_arm(planar3):
    chosen = {"contacts": (last(planar3),) * 2}
    given = upright(planar3) | {
        "rd": tip(planar3, UPRIGHT) - np.array([0.0, 0.3, 0.0]),
        "normals": np.hstack([LEFT_WALL, -LEFT_WALL]),
        "clearances": np.array([0.02, 0.02]),
    }
    given["q"] = UPRIGHT + np.array([0.05, -0.1, 0.05])
    stuck = joint_sign_sets(planar3, **chosen)
    np.testing.assert_allclose(solve(stuck, given), 0.0, atol=1e-12)
    free = clearance_rows(planar3, safe=0.02, **chosen)
    assert np.linalg.norm(solve(free, given)) > 0.1


@pytest.mark.parametrize("scheme", [joint_sign_sets, sign_rows, clearance_rows])
def test_without_contacts_all_are_position_feedback(every, scheme):
    given = parameters(scheme(every), every, 3)
    ours, theirs = data(scheme(every), given), data(position_feedback(every), given)
    for name, value in ours.items():
        np.testing.assert_array_equal(value, theirs[name])


def test_a_reading_is_one_of_two(pa10):
    with pytest.raises(RrnnError, match="reading: expected one of transpose, index"):
        joint_sign_sets(pa10, reading="literal")


# rows


def test_sign_rows_block_what_the_linear_row_lets_slide(pa10):
    sphere = last(pa10)
    given = near(pa10, 4) | {"rd": np.zeros(3)}
    n = np.array([1.0, 1.0, 0.0]) / np.sqrt(2)  # an oblique wall
    given |= {"normals": n[:, None], "clearances": np.array([0.02])}
    J = sphere_jacobian(pa10, sphere, given["q"])
    u = 0.01 * np.linalg.pinv(J) @ np.array([1.0, -1.0, 0.0])  # along it
    assert abs(n @ J @ u) < 1e-9
    assert not admits(sign_rows(pa10, contacts=(sphere,)), given, u)
    tolerant = given | {"clearances": np.array([0.02 + 1e-9])}
    assert admits(clearance_rows(pa10, contacts=(sphere,), safe=0.02), tolerant, u)


@pytest.mark.parametrize("scheme", [clearance_rows, slack_task])
def test_the_linear_row_is_the_rate_of_the_clearance(every, scheme):
    chosen = (last(every) // 2, last(every))
    form = scheme(every, contacts=chosen, gamma=3.0, safe=0.02)
    given = parameters(form, every, 5) | {"clearances": np.array([0.07, 0.01])}
    p = form.qp.at(**given)
    for i, sphere in enumerate(chosen):
        J = sphere_jacobian(every, sphere, given["q"])
        rate = given["normals"][:, i] @ J
        np.testing.assert_allclose(-p.G[i, : every.robot.nv], rate, atol=1e-8)
        assert not p.G[i, every.robot.nv :].any()
    np.testing.assert_allclose(p.h, [3 * 0.05, -3 * 0.01], atol=1e-14)


def test_sign_rows_stand_only_while_a_contact_is_critical(every):
    form = sign_rows(every, contacts=(last(every),), safe=0.05)
    given = near(every, 9) | {"rd": np.zeros(3)}
    close = form.qp.at(**given)
    J = sphere_jacobian(every, last(every), given["q"])
    np.testing.assert_allclose(close.G, -np.sign(given["normals"]) * J, atol=1e-8)
    far = form.qp.at(**given | {"clearances": np.array([0.051])})
    assert not far.G.any()
    assert not close.h.any()
    assert not far.h.any()


@pytest.mark.parametrize(
    "scheme", [sign_rows, gradient_projection, method2, clearance_rows]
)
def test_contacts_may_be_an_array(planar3, scheme):
    chosen = [last(planar3)] * 2
    wanted = [p.name for p in scheme(planar3, contacts=chosen).parameters]
    found = scheme(planar3, contacts=np.array(chosen)).parameters
    assert [p.name for p in found] == wanted
    none = scheme(planar3, contacts=np.array([], dtype=int)).parameters
    assert len(none) == len(scheme(planar3).parameters) < len(wanted)
