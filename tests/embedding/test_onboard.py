"""The planning module does what the scheme and the cell say."""

from __future__ import annotations

import ctypes

import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.dynamics import Euler
from rrnn_opt.embedding import generate
from rrnn_opt.embedding.onboard import Onboard
from rrnn_opt.errors import RrnnError

REACHED, CONTACT, STALLED, SPENT, REFUSED = range(5)
NUMBER = ctypes.c_double


class Node(ctypes.Structure):
    _fields_ = (("q", NUMBER * 3), ("u", NUMBER * 3))


class Goal(ctypes.Structure):
    _fields_ = (
        ("target", NUMBER * 3),
        ("obstacles", NUMBER * 8),
        ("tolerance", NUMBER),
        ("max_steps", ctypes.c_uint32),
    )


class Rollout(ctypes.Structure):
    _fields_ = (
        ("outcome", ctypes.c_int),
        ("steps", ctypes.c_uint32),
        ("error", NUMBER),
        ("clearance", NUMBER),
    )


@pytest.fixture(scope="module")
def onboard():
    kin = rr.Kinematics(rr.Robot.builtin("planar3"))
    last = len(kin.robot.spheres) - 1
    return Onboard(kin, [last // 2, last], obstacles=2)


@pytest.fixture
def roll(onboard, networks, shared, tmp_path):
    package = generate(networks["box"], real="double", onboard=onboard)
    library = shared(package.write(tmp_path))
    library.arm_rollout.restype = Rollout
    library.arm_memory.restype = NUMBER

    def run(q, target, obstacles, tolerance=0.01, steps=4000):
        node = Node((NUMBER * 3)(*q), (NUMBER * 3)())
        flat = np.ravel(obstacles).tolist()
        goal = Goal((NUMBER * 3)(*target), (NUMBER * 8)(*flat), tolerance, steps)
        end = library.arm_rollout(ctypes.byref(node), ctypes.byref(goal))
        return np.array(node.q), np.array(node.u), end

    run.library = library
    return run


START = np.array([0.3, 0.4, 0.5])
FAR = [[50.0, 0.0, 0.0, 0.1], [0.0, 50.0, 0.0, 0.1]]


def tip(onboard, q):
    position = onboard.kinematics.functions()["position"]
    return np.asarray(position(q)).ravel()


def test_it_goes_the_way_of_the_network(onboard, roll):
    target = tip(onboard, START + 0.4)
    kin = onboard.kinematics
    form = rr.formulations.position_feedback(kin, epsilon=onboard.epsilon)
    law = rr.networks.PrimalDual(epsilon=onboard.epsilon)(form)
    step = law.step(Euler(onboard.step)).functions()["step"]
    q, u = START.copy(), np.zeros(3)
    for _ in range(40):
        u = np.asarray(step(u, q, target)[0]).ravel()
        q = q + onboard.step * u
    got_q, got_u, end = roll(START, target, FAR, steps=40)
    assert (end.outcome, end.steps) == (SPENT, 40)
    np.testing.assert_allclose(got_q, q, atol=1e-12)
    np.testing.assert_allclose(got_u, u, atol=1e-10)
    assert end.error == pytest.approx(np.linalg.norm(tip(onboard, q) - target))


def test_every_outcome(onboard, roll):
    target = tip(onboard, START + 0.4)
    q, _, end = roll(START, target, FAR)
    assert end.outcome == REACHED
    assert np.linalg.norm(tip(onboard, q) - target) <= 0.01
    _, _, end = roll(START, [9.0, 0.0, 0.0], FAR)
    assert end.outcome == STALLED
    middle = tip(onboard, START + 0.2)
    q, _, end = roll(START, target, [[*middle, 0.05], FAR[1]])
    assert end.outcome in (CONTACT, STALLED)
    assert end.clearance >= 0.0
    assert np.linalg.norm(tip(onboard, q) - middle) >= 0.05
    q, _, end = roll(START, tip(onboard, START), [[*tip(onboard, START), 0.1], FAR[1]])
    assert (end.outcome, end.steps) == (CONTACT, 0)
    for bad in ([np.nan, 0, 0], [np.inf, 0, 0], [1e200, 0, 0]):
        q, _, end = roll(START, bad, FAR)
        assert end.outcome == REFUSED
        np.testing.assert_array_equal(q, START)


def test_the_cell_is_the_exact_flow(onboard, roll):
    flow = onboard.cell.function()
    for activity in np.linspace(0.0, 1.0, 11):
        for contact in (0, 1):
            got = roll.library.arm_memory(NUMBER(activity), contact)
            assert got == pytest.approx(float(flow(activity, contact)), rel=1e-13)
            assert 0.0 <= got <= 1.0


def test_a_planner_needs_points_and_obstacles(onboard):
    with pytest.raises(RrnnError, match="point"):
        Onboard(onboard.kinematics, [])
    with pytest.raises(RrnnError, match="obstacle"):
        Onboard(onboard.kinematics, [0], obstacles=0)
