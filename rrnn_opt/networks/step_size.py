"""Euler steps with which a network settles."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from rrnn_opt.dynamics import Dynamics, NeuralDynamics

Array = NDArray[np.float64]


def settling_step(
    dynamics: Dynamics, state: Array, parameters: Sequence[Array]
) -> float:
    """An Euler step that is half of the longest stable one, at a given state.

    A mode s of the network's Jacobian is multiplied by 1 + h s a step;
    |1 + h s| is least at h = -Re s / |s|^2, half of what is still stable.  The
    least of these over all decaying modes is taken.  For ``PrimalDual`` with
    P = I the free modes solve eps^2 s^2 + eps s + sigma^2 = 0, sigma the
    singular values of J, which gives h = eps / (2 sigma^2) for sigma >= 1/2; a
    projected coordinate has s = -1/eps and gives h = eps.  With other active
    bounds the modes differ: it is a choice, not a proof of stability; see
    ``euler_bound`` of the networks for what holds whatever is active.

    Args:
        dynamics: the network.
        state: (n,) where it is linearised.
        parameters: one array a parameter, in order, of its shape.

    Returns:
        h, s, at most the network's ``longest_step``; 1 for a network that does
        not move, and for a map.
    """
    if not isinstance(dynamics, NeuralDynamics):
        return 1.0
    slope = np.asarray(_slope(dynamics)(state, *parameters), dtype=np.float64)
    return min(_half(slope), dynamics.longest_step)


def _half(slope: Array) -> float:
    """Half of the longest step that is stable for the modes of a slope."""
    if not np.isfinite(slope).all():
        return 1.0
    modes = np.linalg.eigvals(slope)
    size = np.abs(modes)
    fastest = float(size.max(initial=0.0))
    if fastest == 0.0:
        return 1.0
    decaying = -modes.real > 1e-6 * fastest
    steps = -modes.real[decaying] / size[decaying] ** 2
    return max(float(steps.min(initial=1.0 / fastest)), 1e-3 / fastest)


@lru_cache(maxsize=32)
def _slope(dynamics: NeuralDynamics) -> ca.Function:
    """State and parameters to df/dx."""
    slope = ca.densify(ca.jacobian(dynamics.derivative, dynamics.state.sx))
    inputs = [dynamics.state.sx, *(p.sx for p in dynamics.parameters)]
    return ca.Function("slope", inputs, [slope])
