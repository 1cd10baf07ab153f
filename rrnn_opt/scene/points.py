"""A point cloud as an obstacle: one ball of the same radius about every point."""

from __future__ import annotations

import io
import math
import tokenize
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.errors import DocumentError, ProblemError
from rrnn_opt.files import read_bytes
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
        """One packed sphere a point, (n, 16), m."""
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
        raw = read_bytes(path)
        points = _csv(raw) if path.suffix.lower() == ".csv" else _npy(raw)
    except DocumentError as error:
        raise ProblemError("path", str(error)) from None
    except (OSError, ValueError, EOFError, MemoryError, SyntaxError) as error:
        reason = " ".join(str(error).split())[:200]
        message = f"{path} cannot be read: {reason}"
        raise ProblemError("path", message) from None
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


def _npy(raw: bytes) -> NDArray[Any]:
    """An array whose shape fits the bytes; objects are never unpickled."""
    file = io.BytesIO(raw)
    version = np.lib.format.read_magic(file)
    read = {
        (1, 0): np.lib.format.read_array_header_1_0,
        (2, 0): np.lib.format.read_array_header_2_0,
    }
    if version not in read:
        raise ValueError(f"version {version} of the format")
    try:
        shape, _, dtype = read[version](file)
    except tokenize.TokenError as error:
        raise ValueError(f"its header: {error}") from None
    if dtype.hasobject or dtype.kind not in "fiu":
        raise ValueError(f"it holds {dtype}, not numbers")
    if math.prod(shape) * dtype.itemsize != len(raw) - file.tell():
        raise ValueError(f"its length is not that of {shape} numbers")
    file.seek(0)
    return np.asarray(np.lib.format.read_array(file, allow_pickle=False))


def _csv(raw: bytes) -> NDArray[Any]:
    lines = [line for line in raw.decode("utf-8-sig").splitlines() if line.strip()]
    if not lines:
        return np.zeros((0, 3))
    try:
        [float(word) for word in lines[0].split(",")]
    except ValueError:
        del lines[0]
    if len(lines) > MOST:
        raise ValueError(f"more than {MOST} rows")
    rows = [[float(word) for word in line.split(",")] for line in lines]
    return np.array(rows, dtype=np.float64).reshape(len(rows), -1 if rows else 3)
