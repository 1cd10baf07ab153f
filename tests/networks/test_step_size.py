import casadi as ca
import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.networks.step_size import settling_step


@pytest.fixture(scope="module")
def kin():
    return rr.Kinematics(rr.Robot.builtin("pa10"))


@pytest.fixture(scope="module")
def network(kin):
    return rr.networks.PrimalDual(epsilon=0.01)(rr.formulations.minimum_velocity(kin))


@pytest.fixture(scope="module")
def posture():
    return np.deg2rad([0.0, 30.0, 0.0, 60.0, 0.0, 45.0, 0.0])


def test_the_step_is_half_of_what_is_stable(network, posture, kin):
    """h = min(eps, eps / 2 sigma_max^2) for free modes with sigma >= 1/2."""
    values = [posture.reshape(7, 1), np.zeros((3, 1))]
    h = settling_step(network, np.zeros(10), values)
    jacobian = np.asarray(
        ca.Function("J", [kin.q], [kin.jacobian()])(posture), dtype=float
    )
    largest = np.linalg.norm(jacobian, 2)
    assert largest > 0.5
    assert h == pytest.approx(min(0.01, 0.01 / (2 * largest**2)), rel=1e-6)
    slope = network.functions()["derivative"]
    for factor, settles in ((1.8, True), (2.2, False)):
        x = np.full(10, 0.01)
        for _ in range(4000):
            x = x + factor * h * np.asarray(slope(x, *values)).ravel()
        assert bool(np.abs(x[:7]).max() < 1e-3) is settles


def linear(matrix):
    n = len(matrix)
    x = rr.Symbol.vector("x", n, "1", "state")
    f = ca.SX(matrix) @ x.sx
    return rr.NeuralDynamics(
        name="linear", state=x, parameters=(), derivative=f, output=x.sx, residual=f
    )


@pytest.mark.parametrize(
    ("matrix", "h"),
    [
        (np.diag([-4.0, -1.0]), 0.25),
        (np.array([[-1.0, 3.0], [-3.0, -1.0]]), 0.1),
        (np.zeros((2, 2)), 1.0),
        (np.array([[0.0, 2.0], [-2.0, 0.0]]), 0.5),
        (np.diag([-1.0, 0.0]), 1.0),
    ],
)
def test_known_modes(matrix, h):
    """-Re s / |s|^2 by hand; an undamped mode leaves 1 / |s|, which no h damps."""
    assert settling_step(linear(matrix), np.zeros(2), []) == pytest.approx(h)
