"""toppra behind one function: the fastest path speeds within limits."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache
from typing import Any

import numpy as np

from rrnn_opt.errors import RetimeError
from rrnn_opt.motion import toppra_loading
from rrnn_opt.motion.path import Array
from rrnn_opt.motion.spline import SmoothPath


def parametrised(
    curve: SmoothPath, grid: Array, velocity: Array, acceleration: Array
) -> tuple[Array, Array]:
    """Times and path speeds at the grid's points.

    Between points the path acceleration is constant, so a step takes
    2 ds / (v_i + v_{i+1}).

    Args:
        curve: what is followed.
        grid: its parameters from 0 to 1, (n,).
        velocity: limits in the curve's units, (nv,).
        acceleration: likewise.

    Raises:
        RetimeError: the retimer found nothing.
    """
    with _silence():
        algorithm, _ = toppra_loading.load()
        try:
            bounds = _bounds(tuple(velocity.tolist()), tuple(acceleration.tolist()))
            solver = algorithm.TOPPRA(
                list(bounds), curve, gridpoints=grid, solver_wrapper="seidel"
            )
            solver.compute_parameterization(0.0, 0.0)
        except (ValueError, ArithmeticError, AssertionError) as error:
            raise RetimeError(f"toppra failed: {error}", str(error)) from error
    data = solver.problem_data
    speed = data.sd_vec
    if data.return_code != algorithm.ParameterizationReturnCode.Ok or speed is None:
        reason = str(data.return_code)
        raise RetimeError(f"toppra found no timing: {reason}", reason)
    pace = speed[:-1] + speed[1:]
    if not np.all(np.isfinite(pace)) or np.any(pace <= 0):
        raise RetimeError("toppra stops before the end of the path", "zero speed")
    t = np.concatenate([[0.0], np.cumsum(2 * np.diff(grid) / pace)])
    return t, np.asarray(speed, dtype=np.float64)


@lru_cache(maxsize=64)
def _bounds(
    velocity: tuple[float, ...], acceleration: tuple[float, ...]
) -> tuple[Any, Any]:
    """Constraints for toppra, kept: to make them it prints all their limits."""
    _, constraint = toppra_loading.load()
    rates, pushes = (np.array([-np.array(v), v]).T for v in (velocity, acceleration))
    return constraint.JointVelocityConstraint(
        rates
    ), constraint.JointAccelerationConstraint(
        pushes, discretization_scheme=constraint.DiscretizationType.Interpolation
    )


@contextmanager
def _silence() -> Iterator[None]:
    """Keep toppra's log lines off other people's consoles."""
    logger = logging.getLogger("toppra")
    before = logger.level
    logger.setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        logger.setLevel(before)
