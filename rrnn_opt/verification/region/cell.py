"""One tile of a region: branch and bound on the smallest singular value."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np

from rrnn_opt.robot import Kinematics, Limits
from rrnn_opt.verification.engines.interval.kernel import BATCH, Array
from rrnn_opt.verification.engines.interval.search import halved
from rrnn_opt.verification.engines.interval.tree import Codes
from rrnn_opt.verification.region.euler import Curvature
from rrnn_opt.verification.region.reduced import ReducedArm
from rrnn_opt.verification.region.result import RegionCell
from rrnn_opt.verification.region.singular import SingularBound

_SAFE = 1.0 - 1e-12
QUALITY = 0.7
"""A box is fine enough when its bound is this share of sigma_min in its middle."""


@dataclass(frozen=True)
class Law:
    """The numbers of (18) and of its theorem.

    Attributes:
        epsilon: of (18).
        error: E, the largest |e| spoken of, m.
        delta: least distance of the velocity bounds from 0 that is assumed,
            rad/s; None: that of the limits (10).
        gain: c of (10), 1/s.
        floor: certify no box with a bound of sigma_min below this, m.
    """

    epsilon: float
    error: float
    delta: float | None
    gain: float
    floor: float


@dataclass(frozen=True, eq=False)
class Tools:
    """Compiled kernels of one arm."""

    arm: ReducedArm
    limits: Limits
    singular: SingularBound
    curvature: Curvature

    @staticmethod
    def of(kinematics: Kinematics, frame: str | None) -> Tools:
        """Compile, or find compiled."""
        arm = ReducedArm.of(kinematics, frame)
        singular = SingularBound.of(arm)
        curvature = Curvature.of(kinematics, arm, frame)
        return Tools(arm, kinematics.robot.limits, singular, curvature)


@dataclass
class _Found:
    """Running bounds over the certified leaves."""

    share: float = 0.0
    sigma: float = np.inf
    curvature: float = 0.0
    column: float = 0.0
    boxes: int = 0


def certify_cell(
    tools: Tools,
    law: Law,
    lower: Array,
    upper: Array,
    tile: tuple[tuple[float, float], tuple[float, float]],
    seconds: float,
) -> RegionCell:
    """Certify what can be certified of one box in the given time.

    Args:
        tools: kernels of the arm.
        law: the numbers.
        lower: of all joints, (nv,).
        upper: (nv,).
        tile: lower and upper ends of the two joints of the map.
        seconds: wall time, s.
    """
    end = time.monotonic() + seconds
    active = list(tools.arm.joints)
    low, high = lower[active][:, None].copy(), upper[active][:, None].copy()
    found, volume = _Found(), 1.0
    while low.shape[1]:
        last = time.monotonic() > end or volume < 1e-15
        late = end + 0.25 * seconds
        done, axes = _level(tools, law, low, high, found, volume, last, late)
        low, high = low[:, ~done], high[:, ~done]
        if last or time.monotonic() > late:
            break
        low, high = halved(low, high, axes[~done])
        volume /= 2.0
    return _cell(tools, law, found, (lower, upper), tile, (low, high))


def _level(
    tools: Tools,
    law: Law,
    low: Array,
    high: Array,
    found: _Found,
    volume: float,
    last: bool,
    late: float,
) -> tuple[np.ndarray, Codes]:  # type: ignore[type-arg]
    """Look at all boxes of a level, or at those for which there is time."""
    done, axes = np.zeros(low.shape[1], bool), np.zeros(low.shape[1], np.uint8)
    for start in range(0, low.shape[1], BATCH):
        if start and time.monotonic() > late:
            break
        part = slice(start, start + BATCH)
        bound = tools.singular(low[:, part], high[:, part])
        wanted = law.floor if last else np.maximum(law.floor, QUALITY * bound.centre)
        fine = bound.least >= wanted
        done[part], axes[part] = fine, np.argmax(bound.spread, axis=0)
        found.boxes += len(fine)
        if fine.any():
            L, column = tools.curvature(
                low[:, part][:, fine], high[:, part][:, fine], law.error
            )
            found.share += volume * int(fine.sum())
            found.sigma = min(found.sigma, float(bound.least[fine].min()))
            found.curvature = max(found.curvature, L)
            found.column = max(found.column, column)
    return done, axes


def slack(limits: Limits, gain: float, lower: Array, upper: Array) -> float:
    """Least distance from 0 of the velocity bounds (10) over a box, rad/s.

    Not positive where the box leaves the position limits.
    """
    room = np.minimum(limits.upper - upper, lower - limits.lower)
    return float(np.min(np.minimum(limits.velocity, gain * room))) * _SAFE


def _cell(
    tools: Tools,
    law: Law,
    found: _Found,
    box: tuple[Array, Array],
    tile: tuple[tuple[float, float], tuple[float, float]],
    left: tuple[Array, Array],
) -> RegionCell:
    delta = slack(tools.limits, law.gain, *box) if law.delta is None else law.delta
    residue = _residue(tools, box, left)
    if not found.share or delta <= 0.0 or not np.isfinite(found.curvature):
        nothing = (0.0, 0.0, max(delta, 0.0), 0.0, 0.0)
        return RegionCell(*tile, *nothing, found.boxes, residue or _whole(box))
    drive = found.column * law.error / law.epsilon
    saturation = min(1.0, delta / drive)
    rate = 2.0 * found.sigma**2 / law.epsilon * saturation * _SAFE
    step = 2.0 * law.epsilon / found.curvature * _SAFE
    numbers = (found.share, found.sigma, delta, rate, step)
    return RegionCell(*tile, *numbers, found.boxes, residue)


def _residue(
    tools: Tools, box: tuple[Array, Array], left: tuple[Array, Array]
) -> tuple[tuple[float, ...], tuple[float, ...]] | None:
    """The widest open box, in all joints."""
    low, high = left
    if not low.shape[1]:
        return None
    widest = int(np.argmax(np.sum(high - low, axis=0)))
    lower, upper = box[0].copy(), box[1].copy()
    active = list(tools.arm.joints)
    lower[active], upper[active] = low[:, widest], high[:, widest]
    return _whole((lower, upper))


def _whole(box: tuple[Array, Array]) -> tuple[tuple[float, ...], tuple[float, ...]]:
    return tuple(box[0].tolist()), tuple(box[1].tolist())
