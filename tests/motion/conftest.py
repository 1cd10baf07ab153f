"""Limits of the built-in arms, and of coordinates at will."""

from types import SimpleNamespace

import numpy as np
import pytest


@pytest.fixture(scope="session")
def limits_of():
    """Limits of nv equal coordinates."""

    def make(nv, *, bound=3.0, velocity=2.0, acceleration=10.0):
        return SimpleNamespace(
            lower=np.full(nv, -bound),
            upper=np.full(nv, bound),
            velocity=np.full(nv, velocity),
            acceleration=np.full(nv, acceleration),
        )

    return make


@pytest.fixture(scope="session")
def dense():
    """Largest speed and acceleration ratios at many instants of a trajectory."""

    def ratios(trajectory, limits, n=20001):
        _, qd, qdd = trajectory.at(np.linspace(0, trajectory.duration, n))
        return (
            np.abs(qd / limits.velocity).max(),
            np.abs(qdd / limits.acceleration).max(),
        )

    return ratios
