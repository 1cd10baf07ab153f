"""A point cloud as an obstacle: one ball of the same radius about every point."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.errors import ProblemError
from rrnn_opt.scene import fields as check
from rrnn_opt.scene.digest import sha256
from rrnn_opt.scene.shapes import PACKED

Array = NDArray[np.float64]

MOST = 200_000
"""Points that are accepted at most."""


@dataclass(frozen=True, eq=False)
class Points:
    """All that lies within ``radius`` of a point of a file.

    Attributes:
        name: shown in reports and witnesses.
        path: .npy (n, 3), or .csv with three columns and at most one line of
            names.
        radius: m.
        sha256: digest of the file; given, it must be this one.
        centers: the points, (n, 3), m.

    Raises:
        ProblemError: the file cannot be read, is another one, or holds no or
            too many points, or the radius is not positive.
    """

    kind: ClassVar[str] = "points"
    name: str
    path: str
    radius: float
    sha256: str = ""
    centers: Array = field(init=False, repr=False)

    def __post_init__(self) -> None:
        path = Path(check.text(self.path, "path"))
        values: dict[str, Any] = {
            "name": check.text(self.name, "name"),
            "path": str(path),
            "radius": check.positive(self.radius, "radius"),
            "centers": read_points(path),
            "sha256": sha256(path, self.sha256),
        }
        for key, value in values.items():
            object.__setattr__(self, key, value)

    def to_dict(self) -> dict[str, Any]:
        """The obstacle as the problem file writes it."""
        return {
            "name": self.name,
            "type": self.kind,
            "path": self.path,
            "radius": self.radius,
            "sha256": self.sha256,
        }

    def pack(self) -> Array:
        """One packed sphere a point, (n, 16)."""
        packed = np.zeros((len(self.centers), PACKED))
        packed[:, :9] = np.eye(3).ravel()
        packed[:, 9:12] = self.centers
        packed[:, 12] = self.radius
        return packed


def read_points(path: Path) -> Array:
    """The points of a file, (n, 3), m.

    Raises:
        ProblemError: it cannot be read, or is not n rows of three numbers.
    """
    try:
        points = _csv(path) if path.suffix.lower() == ".csv" else _npy(path)
    except (OSError, ValueError, EOFError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise ProblemError("path", f"{path} cannot be read: {reason}") from None
    if points.ndim != 2 or points.shape[1] != 3 or points.dtype.kind not in "fiu":
        message = f"{path.name} must hold n x 3 numbers, has {points.shape}"
        raise ProblemError("path", message)
    if not 0 < len(points) <= MOST:
        message = f"{path.name} holds {len(points)} points; 1 to {MOST} are accepted"
        raise ProblemError("path", message)
    result = np.array(points, dtype=np.float64)
    if not np.all(np.abs(result) <= check.LARGEST):
        message = f"{path.name} has points that are not finite or beyond 1e6 m"
        raise ProblemError("path", message)
    result.flags.writeable = False
    return result


def _npy(path: Path) -> NDArray[Any]:
    loaded: NDArray[Any] = np.load(path, allow_pickle=False)
    if not isinstance(loaded, np.ndarray):
        raise ValueError("it is no .npy array")
    return loaded


def _csv(path: Path) -> NDArray[Any]:
    with path.open(encoding="utf-8-sig") as file:
        first = file.readline()
    try:
        [float(word) for word in first.split(",")]
    except ValueError:
        return np.loadtxt(
            path, delimiter=",", ndmin=2, skiprows=1, encoding="utf-8-sig"
        )
    return np.loadtxt(path, delimiter=",", ndmin=2, encoding="utf-8-sig")
