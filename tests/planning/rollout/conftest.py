"""What tests of rollouts share."""

import pytest

import rrnn_opt as rr


@pytest.fixture(scope="module")
def planar():
    return rr.Robot.builtin("planar3")
