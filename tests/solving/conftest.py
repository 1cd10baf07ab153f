import numpy as np
import pytest

import rrnn_opt as rr


@pytest.fixture(scope="session")
def kin():
    return rr.Kinematics(rr.Robot.builtin("pa10"))


@pytest.fixture(scope="session")
def form(kin):
    return rr.formulations.minimum_velocity(kin)


@pytest.fixture(scope="session")
def network(form):
    return rr.networks.PrimalDual(epsilon=0.01)(form)


@pytest.fixture(scope="session")
def posture():
    return np.deg2rad([0.0, 30.0, 0.0, 60.0, 0.0, 45.0, 0.0])
