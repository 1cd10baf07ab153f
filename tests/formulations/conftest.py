import pytest

import rrnn_opt as rr


@pytest.fixture(scope="session")
def arms():
    """Kinematics of the built-in robots, by name."""
    names = ["planar3", "pa10", "panda", "raven2"]
    return {name: rr.Kinematics(rr.Robot.builtin(name)) for name in names}


@pytest.fixture(scope="session")
def pa10(arms):
    return arms["pa10"]


@pytest.fixture(scope="session")
def planar3(arms):
    return arms["planar3"]


@pytest.fixture(scope="session", params=["planar3", "pa10", "panda", "raven2"])
def every(arms, request):
    return arms[request.param]
