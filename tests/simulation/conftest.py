import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.simulation import Control, Curve, Noise, Task


@pytest.fixture(scope="session")
def pa10():
    return rr.Robot.builtin("pa10")


@pytest.fixture(scope="session")
def circle():
    """The trial's task: a circle of 0.15 m in the y-z plane in 10 s."""

    def make(*, sigma=0.0, seed=0, enters="joint_velocity", duration=10.0, **control):
        return Task(
            curve=Curve("circle", 10.0, duration, plane="yz", radius=0.15),
            q0=np.deg2rad([0.0, 30.0, 0.0, 60.0, 0.0, 45.0, 0.0]),
            control=Control(**control),
            noise=Noise(enters=enters, sigma=sigma, seed=seed),
        )

    return make
