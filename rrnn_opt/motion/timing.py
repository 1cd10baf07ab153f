"""The fastest timing of a curve: the two passes of TOPP-RA, in closed form.

Along q(s) let x = (ds/dt)^2 and u = d2s/dt2, constant on a step D of the grid,
so that x' = x + 2 D u at its end.  A joint's acceleration limit, at the start
of a step and (H. Pham and Q.-C. Pham, IEEE T-RO 34(3), 2018, eq. 13) at its
end, is a strip of the (u, x) plane,

    |p u + r x| <= a,   (p, r) = (q', q'')  and  (q' + 2 D q'', q'') of the end.

With p >= 0 it says (-a - r x) / p <= u <= (a - r x) / p.  Only u is chosen, so
both passes follow by eliminating it (Fourier and Motzkin):

    x  <= (a_m p_k + a_k p_m) / (r_m p_k - r_k p_m)   lower k, upper m; where > 0
    x  <= (p_k x' + 2 D a_k) / (p_k - 2 D r_k)        backwards; where > 0
    x' <= 2 D a_m / p_m + (1 - 2 D r_m / p_m) x       forwards

and x <= (v / q')^2.  The least bounds of the backward pass are the largest
controllable speeds, those of the forward pass the optimum on the grid.  (0, 0)
lies inside all strips: every curve can be timed.
"""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
FLAT = 1e-12
"""A strip whose p is this small beside the largest bounds x alone."""
HUGE = 1e100
"""In place of infinity, where there must be a number."""


Lines = list[list[tuple[float, float]]]
"""(c, d) of each line x -> c + d x, step by step."""


class Strips(NamedTuple):
    """|p u + r x| <= a on n steps, M strips each, p >= 0.

    Attributes:
        p: (M, n).
        r: (M, n).
        a: (M, 1).
    """

    p: Array
    r: Array
    a: Array


def path_speeds(
    grid: Array, first: Array, second: Array, velocity: Array, acceleration: Array
) -> Array:
    """The largest ds/dt at every point of the grid, zero at both ends.

    Args:
        grid: s, increasing, (n + 1,).
        first: q' there, (n + 1, nv).
        second: q'' there, (n + 1, nv).
        velocity: limits, (nv,).
        acceleration: limits, (nv,).

    Returns:
        (n + 1,); the path acceleration is constant between points.
    """
    step = 2 * np.diff(grid)
    strips = _strips(step, first.T, second.T, acceleration)
    with np.errstate(all="ignore"):
        cap = ((velocity[:, None] / np.abs(first.T)) ** 2).min(axis=0)
        cap[:-1] = _slice_ends(step, strips, cap[:-1])
        cap[-1] = 0.0
        back = _backward_lines(step, strips, cap[:-1])
        best = _backwards(cap.tolist(), back)
        forth = _forward_lines(step, strips, np.array(best))
        speeds: Array = np.sqrt(np.array(_forwards(best, forth)))
    return speeds


def _strips(step: Array, first: Array, second: Array, limit: Array) -> Strips:
    late = first[:, 1:] + step * second[:, 1:]
    p = np.concatenate([first[:, :-1], late])
    r = np.concatenate([second[:, :-1], second[:, 1:]])
    r = np.where(p < 0, -r, r)
    p = np.abs(p)
    p[p <= FLAT * p.max()] = 0.0
    return Strips(p, r, np.concatenate([limit, limit])[:, None])


def _slice_ends(step: Array, strips: Strips, cap: Array) -> Array:
    """Largest x <= cap for which some u keeps all strips and x' >= 0, (n,).

    The width of the slice, least upper minus greatest lower bound of u, is a
    concave function of x with straight pieces.  Newton's method comes down from
    the right, piece by piece, and ends at the root.
    """
    p, r, a = strips
    alone = np.where(p == 0, a / np.abs(r), np.inf).min(axis=0)
    x: Array = np.minimum(np.minimum(cap, alone), HUGE)
    room, lean = np.where(p > 0, a / p, np.inf), np.where(p > 0, r / p, 0.0)
    # x' >= 0 is a lower side, too: u >= -x / 2 D
    most, sink = np.vstack([room, 0 * step]), np.vstack([lean, 1 / step])
    every = np.arange(len(step))
    for _ in range(2 * len(room)):
        up, low = np.argmin(room - lean * x, axis=0), np.argmin(most + sink * x, axis=0)
        fall = lean[up, every] - sink[low, every]
        root = (room[up, every] + most[low, every]) / fall
        lower = np.where((fall > 0) & (root < x), root, x)
        if np.all(lower >= x):
            break
        x = lower
    return x


def _backward_lines(step: Array, strips: Strips, cap: Array) -> Lines:
    below = strips.p - step * strips.r
    fit = below > 0
    start = np.where(fit, step * strips.a / below, np.inf)
    slope = np.where(fit, strips.p / below, 0.0)
    return _lines(start, slope, start < cap)


def _forward_lines(step: Array, strips: Strips, best: Array) -> Lines:
    turn = strips.p > 0
    start = np.where(turn, step * strips.a / strips.p, np.inf)
    slope = np.where(turn, 1 - step * strips.r / strips.p, 0.0)
    least = np.minimum(start, start + slope * best[:-1])
    return _lines(start, slope, least < best[1:])


def _lines(start: Array, slope: Array, needed: NDArray[np.bool_]) -> Lines:
    """The lines of each step, those left out that another bound makes needless."""
    k, line = np.nonzero(needed.T)
    rows = zip(start[line, k].tolist(), slope[line, k].tolist(), strict=True)
    pairs, ends = list(rows), [0, *np.cumsum(needed.sum(axis=0)).tolist()]
    return [pairs[i:j] for i, j in pairwise(ends)]


def _backwards(cap: list[float], lines: Lines) -> list[float]:
    """Largest x from which the end can be reached at rest, n + 1."""
    best, x = cap.copy(), cap[-1]
    for k in range(len(lines) - 1, -1, -1):
        best[k] = x = min([cap[k], *[c + d * x for c, d in lines[k]]])
    return best


def _forwards(best: list[float], lines: Lines) -> list[float]:
    """The greatest x that can be reached from rest, n + 1."""
    x, found = 0.0, [0.0]
    for most, pairs in zip(best[1:], lines, strict=True):
        x = max(0.0, min([most, *[c + d * x for c, d in pairs]]))
        found.append(x)
    return found
