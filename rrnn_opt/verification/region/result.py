"""What is certified of a region, as frozen data."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.arguments import checked
from rrnn_opt.errors import NotFiniteError, RrnnError, ShapeError
from rrnn_opt.robot import Kinematics

KIND = "rrnn_opt region map"
HALF_WIDTH, _MARGIN = 0.5, 0.1


@checked()
@dataclass(frozen=True)
class Region:
    """A box of joint positions.

    Attributes:
        centre: (nv,), rad or m.
        half_widths: (nv,), rad or m, not negative.

    Raises:
        ShapeError: the two differ in length.
        NotFiniteError: a number is NaN or infinite.
        RrnnError: a half-width is negative.
    """

    centre: tuple[float, ...]
    half_widths: tuple[float, ...]

    def __post_init__(self) -> None:
        want, got = (len(self.centre),), (len(self.half_widths),)
        if want != got:
            raise ShapeError("half_widths", want, got)
        if not np.all(np.isfinite([*self.centre, *self.half_widths])):
            raise NotFiniteError("region")
        if min(self.half_widths) < 0.0:
            raise RrnnError("region: half-widths are not negative")

    @staticmethod
    def working(
        kinematics: Kinematics, *, half_width: float = HALF_WIDTH, seed: int = 0
    ) -> Region:
        """A box about the best-conditioned of 512 drawn postures.

        It keeps 0.1 rad away from the position limits where there is room.

        Args:
            kinematics: of the arm.
            half_width: of every joint, rad or m.
            seed: of the draw.
        """
        limits = kinematics.robot.limits
        away = half_width + _MARGIN
        low = np.maximum(limits.lower, -np.pi) + away
        high = np.minimum(limits.upper, np.pi) - away
        tight = low > high
        low[tight] = high[tight] = 0.5 * (limits.lower + limits.upper)[tight]
        rng = np.random.default_rng(seed)
        draws = low + (high - low) * rng.random((512, len(low)))
        jacobian = kinematics.functions()["jacobian"]
        least = [np.linalg.svd(_moving(jacobian(q)))[1][-1] for q in draws]
        best = np.round(draws[int(np.argmax(least))], 2)
        return Region(tuple(best.tolist()), (half_width,) * len(low))

    @property
    def lower(self) -> NDArray[np.float64]:
        """Lower ends, (nv,), rad or m."""
        ends: NDArray[np.float64] = np.subtract(self.centre, self.half_widths)
        return ends

    @property
    def upper(self) -> NDArray[np.float64]:
        """Upper ends, (nv,), rad or m."""
        ends: NDArray[np.float64] = np.add(self.centre, self.half_widths)
        return ends


def _moving(matrix: Any) -> NDArray[np.float64]:
    full = np.asarray(matrix, dtype=np.float64)
    rows: NDArray[np.float64] = full[np.any(full != 0.0, axis=1)]
    return rows


@dataclass(frozen=True)
class RegionCell:
    """One tile of a map: a range of two joints, all of the others.

    The bounds hold on the certified part of the tile, ``share`` of its volume.

    Attributes:
        lower: of the two joints, rad.
        upper: rad.
        share: certified part of the volume, 0 to 1.
        sigma: sigma_min(J) >= sigma there; 0 where nothing is certified, m.
        delta: velocity bounds stay this far from 0, rad/s.
        rate: alpha with V' <= -alpha V, 1/s.
        step: largest Euler step that keeps V from growing, s.
        boxes: boxes looked at.
        residue: (lower, upper) of the widest open box in all joints, or None.
    """

    lower: tuple[float, float]
    upper: tuple[float, float]
    share: float
    sigma: float
    delta: float
    rate: float
    step: float
    boxes: int
    residue: tuple[tuple[float, ...], tuple[float, ...]] | None = None


@dataclass(frozen=True)
class RegionMap:
    """Result of :func:`rrnn_opt.certify_region`.

    Attributes:
        robot: its name.
        region: what was asked about.
        joints: the two joints that the tiles divide.
        epsilon: of (18), s.
        error: E, the largest |e| spoken of, m.
        floor: boxes with sigma_min below it are not certified, m.
        cells: tiles, the second joint running fastest.
        assumptions: what the theorem needs besides.
        time_s: wall time, s.
    """

    robot: str
    region: Region
    joints: tuple[int, int]
    epsilon: float
    error: float
    floor: float
    cells: tuple[RegionCell, ...]
    assumptions: tuple[str, ...]
    time_s: float

    @property
    def share(self) -> float:
        """Certified share of the region's volume."""
        return float(np.mean([cell.share for cell in self.cells]))

    @property
    def sigma(self) -> float:
        """Least certified bound of sigma_min(J) on the certified part, m."""
        return min((c.sigma for c in self.cells if c.share), default=0.0)

    @property
    def rate(self) -> float:
        """Least alpha on the certified part, 1/s."""
        return min((c.rate for c in self.cells if c.share), default=0.0)

    @property
    def step(self) -> float:
        """Euler step that is short enough on all of the certified part, s."""
        return min((c.step for c in self.cells if c.share), default=0.0)

    def to_dict(self) -> dict[str, Any]:
        """The map as plain data, for JSON and :func:`rrnn_opt.report.draw_region`."""
        whole = {
            name: getattr(self, name) for name in ("share", "sigma", "rate", "step")
        }
        return {"kind": KIND, "schema": 1} | whole | asdict(self)
