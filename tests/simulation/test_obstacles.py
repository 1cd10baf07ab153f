"""What the loop tells of obstacles: contacts, clearances, stored magnitudes."""

from dataclasses import replace

import casadi as ca
import numpy as np
import pytest

from rrnn_opt import formulations
from rrnn_opt.formulations.signs import magnitudes
from rrnn_opt.scene import Box, Scene
from rrnn_opt.simulation import Curve, simulate
from rrnn_opt.simulation.obstacles import default_contacts
from tests.simulation.oracle import BALL, Oracle, optimum


@pytest.fixture(scope="module")
def blocked(pa10, circle):
    scene = Scene((BALL,))
    task = circle(duration=10.0, sigma=0.0)
    curve = Curve("line", 6.0, 6.0, offset=np.array([-0.2, 0.6, 0.1]))
    return replace(task, curve=curve, scene=scene)


@pytest.mark.parametrize(
    "name",
    [
        "clearance_rows",
        pytest.param("sign_rows", marks=pytest.mark.slow),
        pytest.param("joint_sign_sets", marks=pytest.mark.slow),
    ],
)
def test_contacts_are_those_of_the_scene(pa10, blocked, name):
    contacts = default_contacts(pa10)
    result = simulate(name, pa10, blocked)
    oracle = Oracle(result, contacts, BALL)
    form = getattr(formulations, name)(oracle.kin, contacts=contacts)
    names = [p.name for p in form.parameters]
    free = getattr(formulations, name)(oracle.kin)
    acted = 0
    for k in range(0, result.steps, 37):
        given = oracle.at(k, names)
        want = optimum(form, given)
        np.testing.assert_allclose(result.command[k], want, atol=1e-5)
        without = {n: given[n] for n in ("q", "rd")}
        acted += np.abs(want - optimum(free, without)).max() > 1e-4
    assert acted > 2
    gaps = [oracle.gaps(q)[0].min() for q in result.q]
    assert result.least_clearance_m <= min(gaps) + 1e-9
    assert min(gaps) > -1e-6


@pytest.mark.slow
def test_the_clearance_row_keeps_what_feedback_alone_does_not(pa10, blocked):
    moving = tuple(k for k, s in enumerate(pa10.spheres) if s.joint >= 0)[::3]
    kept = simulate("clearance_rows", pa10, replace(blocked, contacts=moving))
    assert kept.record.unsettled == 0
    hit = simulate("position_feedback", pa10, blocked)
    assert kept.least_clearance_m > 0.005
    assert hit.least_clearance_m < -0.01


def nudged(kin, *, contacts=()):
    """Feedback whose joints 1 to 6 also move at the stored magnitudes."""
    form = formulations.sign_rows(kin, contacts=contacts)
    stored = magnitudes(len(contacts))
    nudge = ca.vertcat(stored.sx[:6], ca.SX(1, 1))
    u = form.decision.sx
    return replace(
        form,
        parameters=(*form.parameters, stored),
        cost=form.cost - ca.dot(nudge, u),
        inequalities=None,
        lower=None,
        upper=None,
    )


def test_magnitudes_are_stored_when_a_contact_comes_near(pa10, blocked):
    """The approach at entry, kept within the outer distance, dropped beyond it."""
    contacts = default_contacts(pa10)[-2:]
    result = simulate(nudged, pa10, replace(blocked, contacts=contacts))
    oracle = Oracle(result, contacts, BALL)
    stored, was = np.zeros(6), np.zeros(2, bool)
    entered = left = 0
    for k in range(result.steps):
        gap, normal = oracle.gaps(result.q[k])
        before = result.qd[k - 1] if k else np.zeros(7)
        for i, sphere in enumerate(contacts):
            now = gap[i] <= 0.1
            if now and not was[i]:
                speed = jacobian(oracle.kin, sphere, result.q[k]) @ before
                approach = np.maximum(-np.sign(normal[:, i]) * speed, 0)
                stored[3 * i : 3 * i + 3] = approach
                entered += bool(approach.any())
            elif was[i] and not now:
                left += 1
            if not now:
                stored[3 * i : 3 * i + 3] = 0.0
            was[i] = now
        J = np.asarray(oracle.fn["jacobian"](result.q[k]))
        want = J.T @ result.error[k] / 0.01 + np.append(stored, 0.0)
        np.testing.assert_allclose(result.command[k], want, atol=1e-6)
    assert entered
    assert left


def jacobian(kin, sphere, q):
    steps = 1e-6 * np.eye(kin.robot.nv)
    centre = ca.Function("c", [kin.q], [kin.sphere_centres()[:, sphere]])
    return np.hstack([np.asarray(centre(q + s) - centre(q - s)) / 2e-6 for s in steps])


def test_a_box_and_a_ball_the_nearest_counts(pa10, circle):
    wall = Box("wall", np.array([0.1, 4.0, 4.0]), np.array([1.2, 0.0, 0.0]))
    both = replace(circle(duration=0.1), scene=Scene((wall, BALL)))
    alone = replace(circle(duration=0.1), scene=Scene((BALL,)))
    runs = [simulate("clearance_rows", pa10, task) for task in (both, alone)]
    assert runs[0].least_clearance_m <= runs[1].least_clearance_m
    assert (
        simulate("clearance_rows", pa10, circle(duration=0.1)).least_clearance_m is None
    )
