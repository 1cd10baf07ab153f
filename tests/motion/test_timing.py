"""Oracles: toppra, which solves a linear program at every point; known optima."""

import logging
from dataclasses import dataclass, field

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.motion.path import Path
from rrnn_opt.motion.spline import SmoothPath
from rrnn_opt.motion.timing import path_speeds


@dataclass
class AsToppra:
    """Our curve with what toppra asks of a path."""

    curve: SmoothPath
    dof: int
    path_interval: np.ndarray = field(default_factory=lambda: np.array([0.0, 1.0]))
    duration: float = 1.0

    def __call__(self, s, order=0):
        return self.curve(s, order)


def linear_programs(curve, grid, velocity, acceleration):
    """Speeds that toppra finds."""
    from toppra import algorithm, constraint

    logging.getLogger("toppra").setLevel(logging.CRITICAL)
    at_both_ends = constraint.DiscretizationType.Interpolation
    limits = [np.stack([-v, v], axis=1) for v in (velocity, acceleration)]
    bounds = [
        constraint.JointVelocityConstraint(limits[0]),
        constraint.JointAccelerationConstraint(
            limits[1], discretization_scheme=at_both_ends
        ),
    ]
    path = AsToppra(curve, len(velocity))
    solver = algorithm.TOPPRA(bounds, path, gridpoints=grid, solver_wrapper="seidel")
    solver.compute_parameterization(0.0, 0.0)
    return solver.problem_data.sd_vec


def duration(grid, speed):
    return float(np.sum(2 * np.diff(grid) / (speed[1:] + speed[:-1])))


@settings(max_examples=25, deadline=None, derandomize=True)
@given(
    seed=st.integers(0, 10**6),
    nv=st.integers(1, 8),
    spacing=st.sampled_from([0.3, 0.1, 0.05]),
)
def test_it_is_as_fast_as_linear_programs_are(seed, nv, spacing):
    rng = np.random.default_rng(seed)
    path = Path(rng.uniform(-1, 1, (int(rng.integers(2, 9)), nv)))
    curve = SmoothPath(path, spacing=spacing, scale=path.length)
    grid, velocity = curve.grid(60), rng.uniform(0.5, 2, nv)
    acceleration = rng.uniform(0.5, 3, nv)
    ours = path_speeds(grid, curve(grid, 1), curve(grid, 2), velocity, acceleration)
    theirs = linear_programs(curve, grid, velocity, acceleration)
    # toppra's programs are solved to about 1e-8, and keep 1e-6 away at times
    np.testing.assert_allclose(ours, theirs, atol=1e-4 * ours.max())
    assert duration(grid, ours) <= duration(grid, theirs) * (1 + 1e-6)


@settings(max_examples=25, deadline=None, derandomize=True)
@given(seed=st.integers(0, 10**6), nv=st.integers(1, 30))
def test_every_limit_is_kept_at_the_points(seed, nv):
    rng = np.random.default_rng(seed)
    n = int(rng.integers(2, 60))
    grid = np.cumsum(rng.uniform(0.1, 1, n + 1))
    first, second = rng.normal(size=(2, n + 1, nv))
    velocity, acceleration = rng.uniform(0.5, 2, (2, nv))
    speed = path_speeds(grid, first, second, velocity, acceleration)
    assert speed[0] == speed[-1] == 0.0
    assert np.all(speed[1:] + speed[:-1] > 0)
    u = np.diff(speed**2) / (2 * np.diff(grid))
    here = first[:-1] * u[:, None] + second[:-1] * speed[:-1, None] ** 2
    there = first[1:] * u[:, None] + second[1:] * speed[1:, None] ** 2
    pushes = np.concatenate([here, there]) / acceleration
    rates = first * speed[:, None] / velocity
    assert np.abs(pushes).max() <= 1 + 1e-9
    assert np.abs(rates).max() <= 1 + 1e-9


@pytest.mark.parametrize("nv", [1, 3])
def test_a_line_is_run_by_bang_cruise_bang(nv):
    grid = np.linspace(0, 1, 1001)
    first = np.full((1001, nv), 2.0)
    speed = path_speeds(grid, first, 0 * first, np.full(nv, 1.0), np.full(nv, 4.0))
    expected = np.minimum(np.sqrt(4 * np.minimum(grid, 1 - grid)), 0.5)
    np.testing.assert_allclose(speed, expected, atol=1e-12)


def test_a_curve_that_turns_back_is_passed_where_it_stands():
    """q' = 0 at the turn: the acceleration limit alone bounds the speed there."""
    grid = np.linspace(-1, 1, 201)
    first, second = -2 * grid[:, None], np.full((201, 1), -2.0)  # q = 1 - s^2
    speed = path_speeds(grid, first, second, np.array([9.0]), np.array([1.0]))
    assert speed[100] == pytest.approx(np.sqrt(1 / 2), rel=1e-12)
