"""Vertices of mesh files and rows of point files, read here on our own."""

from __future__ import annotations

import hashlib
import os
import stat
import struct
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from rrnn_opt.check.plans import reading
from rrnn_opt.check.plans.reading import Array, get
from rrnn_opt.errors import DocumentError

LARGEST = 256 * 2**20
"""Bytes of a mesh or point file that are read."""


def read_points(entry: Mapping[str, Any], name: str) -> Array:
    """The points of an obstacle's file (.npy, .csv, .stl or .obj), (n, 3).

    Raises:
        DocumentError: the file is not there, is another one than the document
            speaks of, or holds no finite points.
    """
    path = Path(reading.text(get(entry, "path", name), f"{name}.path"))
    try:
        read = _reader(path.suffix.lower())
        raw = _bytes(path)
        found = read(raw)
        if not len(found):  # an obstacle of nothing would never be hit
            raise ValueError("it holds no points")
    except (OSError, ValueError, TypeError, LookupError, struct.error) as error:
        raise DocumentError(f"{name}.path", f"{path} is unreadable: {error}") from None
    digest = entry.get("sha256")
    if digest and digest != hashlib.sha256(raw).hexdigest():
        raise DocumentError(f"{name}.path", f"{path} has changed since the plan")
    return reading.numbers(found, (None, 3), f"{name}.path")


def _bytes(path: Path) -> bytes:
    """All bytes of a regular file; a pipe or a device would never end."""
    with open(os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0)), "rb") as file:
        found = os.fstat(file.fileno())
        if not stat.S_ISREG(found.st_mode) or found.st_size > LARGEST:
            raise ValueError(f"no file of at most {LARGEST >> 20} MiB")
        return file.read(LARGEST)


def _reader(suffix: str) -> Any:
    return {".npy": _npy, ".csv": _csv, ".stl": _stl, ".obj": _obj}[suffix]


def _npy(raw: bytes) -> Array:
    """Version 1 to 3 of the format: magic, header length, header, data."""
    if raw[:6] != b"\x93NUMPY":
        raise ValueError("no .npy file")
    wide = raw[6] > 1
    (length,) = struct.unpack_from("<I" if wide else "<H", raw, 8)
    begin = (12 if wide else 10) + length
    header = reading.literal(raw[12 if wide else 10 : begin].decode("latin1"))
    data = np.frombuffer(raw, np.dtype(header["descr"]), offset=begin)
    if header["fortran_order"]:
        data = data.reshape(header["shape"], order="F")
    return np.array(data.reshape(header["shape"]), dtype=np.float64)


def _csv(raw: bytes) -> Array:
    lines = [line.split(",") for line in raw.decode("utf-8-sig").splitlines() if line]
    try:
        return np.array(lines, dtype=np.float64)
    except ValueError:  # the first line holds names
        return np.array(lines[1:], dtype=np.float64)


def _stl(raw: bytes) -> Array:
    count = int.from_bytes(raw[80:84], "little")
    if len(raw) != 84 + 50 * count:
        return _words(raw, b"vertex")
    body = np.frombuffer(raw, np.uint8, offset=84).reshape(count, 50)[:, 12:48]
    return np.frombuffer(body.tobytes(), "<f4").reshape(-1, 3).astype(np.float64)


def _obj(raw: bytes) -> Array:
    return _words(raw, b"v")


def _words(raw: bytes, word: bytes) -> Array:
    split = (line.split() for line in raw.splitlines())
    rows = [[float(x) for x in row[1:4]] for row in split if row and row[0] == word]
    return np.array(rows, dtype=np.float64).reshape(-1, 3)
