"""Vertices and triangles of STL and OBJ files; other formats through trimesh.

Of a scene of several parts all vertices count.  Lengths are the file's own.
"""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.errors import DocumentError, ProblemError
from rrnn_opt.files import read_bytes

Array = NDArray[np.float64]
LARGEST_FILE = 256 * 2**20
"""Bytes that are read at most."""
_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("extra", "<u2")])


def read_vertices(path: Path, field: str = "path") -> Array:
    """All vertices of a mesh file, (n, 3), without those that come twice.

    Args:
        path: an .stl (binary or text) or .obj file; others need trimesh.
        field: name of the field, for messages.

    Raises:
        ProblemError: it cannot be read, or holds no finite vertices.
    """
    raw = _bytes(path, field)
    readers = {".stl": _stl, ".obj": _obj}
    reader = readers.get(path.suffix.lower())
    try:
        points = _other(path, field) if reader is None else reader(raw)
    except (ValueError, UnicodeDecodeError, struct.error) as error:
        message = f"{path.name} is no readable mesh: {error}"
        raise ProblemError(field, message) from None
    if not len(points) or not np.all(np.isfinite(points)):
        raise ProblemError(field, f"{path.name} holds no finite vertices")
    unique: Array = np.unique(points, axis=0)
    return unique


def _bytes(path: Path, field: str) -> bytes:
    try:
        return read_bytes(path, most=LARGEST_FILE)
    except DocumentError as error:
        raise ProblemError(field, str(error)) from None


def _stl(raw: bytes) -> Array:
    """Corners of an STL's triangles; binary when the length says so."""
    if len(raw) >= 84:
        (count,) = struct.unpack_from("<I", raw, 80)
        if len(raw) == 84 + 50 * count:
            corners = np.frombuffer(raw, _RECORD, count, 84)["corners"]
            return np.asarray(corners.reshape(-1, 3), dtype=np.float64)
    return _lines(raw.decode("ascii"), "vertex")


def _obj(raw: bytes) -> Array:
    return _lines(raw.decode("utf-8"), "v")


def _lines(text: str, word: str) -> Array:
    """The three numbers of every line that begins with ``word``."""
    rows = [
        line.split()[1:4] for line in text.splitlines() if line.split()[:1] == [word]
    ]
    return np.array(rows, dtype=np.float64).reshape(-1, 3)


def _other(path: Path, field: str) -> Array:
    try:
        import trimesh
    except ImportError:
        message = f"{path.suffix or path.name} needs trimesh (pip install trimesh)"
        raise ProblemError(field, f"{message}; .stl and .obj do not") from None
    try:
        loaded = trimesh.load(path, force="mesh")
    except Exception as error:  # its readers raise what they like
        raise ValueError(f"trimesh says {error}") from None
    return np.asarray(getattr(loaded, "vertices", ()), dtype=np.float64).reshape(-1, 3)
