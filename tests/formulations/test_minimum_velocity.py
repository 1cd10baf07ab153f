import casadi as ca
import numpy as np
import pytest
import qpsolvers

import rrnn_opt as rr
from rrnn_opt.errors import (
    InfeasibleQpError,
    NotAQpError,
    NotFiniteError,
    RobotError,
    RrnnError,
    ShapeError,
)
from rrnn_opt.networks import PrimalDual

ROBOTS = ["planar3", "pa10", "panda", "raven2"]


@pytest.fixture(scope="module", params=ROBOTS)
def kin(request):
    return rr.Kinematics(rr.Robot.builtin(request.param))


@pytest.fixture(scope="module")
def arm():
    return rr.Kinematics(rr.Robot.builtin("pa10"))


def posture(kin, seed=0):
    """Inside the limits, a tenth of the range away from them."""
    limits, rng = kin.robot.limits, np.random.default_rng(seed)
    low = np.where(np.isfinite(limits.lower), limits.lower, -3.0)
    high = np.where(np.isfinite(limits.upper), limits.upper, 3.0)
    return low + (high - low) * rng.uniform(0.1, 0.9, kin.robot.nv)


def test_the_programme_at_a_posture(kin):
    form = rr.formulations.minimum_velocity(kin)
    q, rate, limits = posture(kin), np.array([0.02, -0.01, 0.0]), kin.robot.limits
    problem = form.qp.at(q=q, rd_dot=rate)
    np.testing.assert_array_equal(problem.P, np.eye(kin.robot.nv))
    np.testing.assert_array_equal(problem.q, 0.0)
    jacobian = np.asarray(kin.functions()["jacobian"](q))
    np.testing.assert_allclose(problem.A, jacobian, atol=1e-15)
    np.testing.assert_array_equal(problem.b, rate)
    low = np.maximum(-0.5 * (q - limits.lower), -limits.velocity)
    high = np.minimum(-0.5 * (q - limits.upper), limits.velocity)
    np.testing.assert_allclose(problem.lb, low)
    np.testing.assert_allclose(problem.ub, high)
    assert problem.G is None


def test_the_optimum_is_the_networks_equilibrium(kin):
    form = rr.formulations.minimum_velocity(kin)
    residual = PrimalDual()(form).functions()["residual"]
    for seed in range(5):
        q = posture(kin, seed)
        box = form.qp.at(q=q, rd_dot=np.zeros(3))
        jacobian = np.asarray(kin.functions()["jacobian"](q))
        velocity = np.random.default_rng(seed).uniform(box.lb, box.ub)
        rate = 0.5 * jacobian @ velocity  # feasible, also in a singular plane
        problem = form.qp.at(q=q, rd_dot=rate)
        best = qpsolvers.solve_problem(problem, solver="daqp", primal_tol=1e-10)
        assert best.found
        state = np.concatenate([best.x, -best.y])  # the lambda of (4) is -y
        assert np.abs(np.asarray(residual(state, q, rate))).max() < 1e-8


def test_unbounded_optimum_is_the_pseudoinverse(arm):
    form = rr.formulations.minimum_velocity(arm)
    q, rate = posture(arm), np.array([0.02, -0.01, 0.015])
    best = qpsolvers.solve_problem(form.qp.at(q=q, rd_dot=rate), solver="daqp")
    jacobian = np.asarray(arm.functions()["jacobian"](q))
    np.testing.assert_allclose(best.x, np.linalg.pinv(jacobian) @ rate, atol=1e-9)


def test_weights_enter_as_in_3a(arm):
    W, c = np.diag(np.arange(1.0, 8.0)), np.linspace(-1, 1, 7)
    W[0, 1] = W[1, 0] = 0.5
    form = rr.formulations.minimum_velocity(arm, W=W, c=c)
    problem = form.qp.at(q=posture(arm), rd_dot=np.zeros(3))
    np.testing.assert_array_equal(problem.P, 2 * W)
    np.testing.assert_array_equal(problem.q, c)


def test_another_frame(arm):
    name = arm.robot.frames[0].name
    form = rr.formulations.minimum_velocity(arm, frame=name)
    q = posture(arm)
    f = ca.Function("f", [arm.q], [arm.jacobian(name)])
    problem = form.qp.at(q=q, rd_dot=np.zeros(3))
    np.testing.assert_allclose(problem.A, np.asarray(f(q)), atol=1e-15)
    with pytest.raises(RobotError, match="no frame 'nose'"):
        rr.formulations.minimum_velocity(arm, frame="nose")


def test_far_outside_the_limits_the_box_is_empty(arm):
    form = rr.formulations.minimum_velocity(arm)
    q = posture(arm)
    q[0] = arm.robot.limits.upper[0] + 3 * arm.robot.limits.velocity[0]
    with pytest.raises(InfeasibleQpError, match="bound 0 is empty"):
        form.qp.at(q=q, rd_dot=np.zeros(3))


@pytest.mark.parametrize(
    ("changes", "error"),
    [
        ({"W": np.eye(6)}, ShapeError),
        ({"W": 2.0}, ShapeError),
        ({"W": np.ones(7)}, ShapeError),
        ({"c": np.ones((7, 1))}, ShapeError),
        ({"c": 1.0}, ShapeError),
        ({"W": np.diag([np.nan] * 7)}, NotFiniteError),
        ({"W": -np.eye(7)}, NotAQpError),
        ({"W": np.eye(7) + np.eye(7, k=1)}, RrnnError),
        ({"c1": 0.0}, RrnnError),
    ],
)
def test_bad_settings_are_refused(arm, changes, error):
    with pytest.raises(error):
        rr.formulations.minimum_velocity(arm, **changes)


@pytest.mark.parametrize("name", ["pa10", "panda"])
def test_the_pose_task_has_six_rows_and_the_pose_pseudoinverse(name):
    arm = rr.Kinematics(rr.Robot.builtin(name))
    form = rr.formulations.minimum_velocity(arm, task="pose")
    q, rate = posture(arm, 3), np.array([0.01, -0.005, 0.01, 0.02, -0.01, 0.015])
    jacobian = np.asarray(arm.functions()["pose_jacobian"](q))
    problem = form.qp.at(q=q, rd_dot=rate)
    np.testing.assert_allclose(problem.A, jacobian, atol=1e-15)
    np.testing.assert_array_equal(problem.b, rate)
    best = qpsolvers.solve_problem(problem, solver="daqp")
    np.testing.assert_allclose(best.x, np.linalg.pinv(jacobian) @ rate, atol=1e-9)


def test_there_are_two_kinds_of_task(arm):
    with pytest.raises(RrnnError, match="task 'gaze': use 'position' or 'pose'"):
        rr.formulations.minimum_velocity(arm, task="gaze")
