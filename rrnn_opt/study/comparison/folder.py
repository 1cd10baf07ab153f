"""A folder of QPs, one file each, as ``qpsolvers.Problem.save`` writes them."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from rrnn_opt.errors import DocumentError, RrnnError
from rrnn_opt.files import LARGEST_DOCUMENT, read_bytes, shown_path

KEYS = ("P", "q", "G", "h", "A", "b", "lb", "ub")
"""Arrays of a file: min x'P x / 2 + q'x, G x <= h, A x = b, lb <= x <= ub."""
MATRICES = ("P", "G", "A")


def read_folder(path: str) -> list[tuple[str, dict[str, Any]]]:
    """The arrays of every ``.npz`` file of a folder, in the order of the names.

    Args:
        path: of the folder.

    Returns:
        Pairs of a file's path and its arrays, flat, row by row; None for those
        that the file does not hold.

    Raises:
        RrnnError: the folder has no such file.
        DocumentError: a file is no archive of arrays, or a matrix has not one
            column for each element of q.
    """
    files = sorted(Path(path).glob("*.npz"))
    if not files:
        raise RrnnError(
            f"{shown_path(path)}: holds no .npz files, one a problem, as"
            " qpsolvers.Problem.save writes them"
        )
    return [(shown_path(file), _arrays(file)) for file in files]


def _arrays(file: Path) -> dict[str, Any]:
    """What a file holds; objects in it (None, or a pickle) are never read."""
    raw, where = read_bytes(file), shown_path(file)
    try:
        with zipfile.ZipFile(io.BytesIO(raw)) as archive:
            if sum(part.file_size for part in archive.infolist()) > LARGEST_DOCUMENT:
                raise DocumentError(where, "holds too much")
        with np.load(io.BytesIO(raw), allow_pickle=False) as held:
            found = {key: _array(held, key) for key in KEYS}
    except DocumentError:
        raise
    except Exception as error:  # NumPy and zipfile raise what they like
        reason = " ".join(str(error).split())[:80]
        raise DocumentError(where, f"is no .npz file ({reason})") from error
    return _flat(found, where)


def _array(held: Mapping[str, Any], key: str) -> Any:
    if key not in held:
        return None
    try:
        return held[key]
    except ValueError:  # an object: what is missing is saved as None
        return None


def _flat(found: Mapping[str, Any], where: str) -> dict[str, Any]:
    """Arrays row by row, once their shapes are known to fit.

    Raises:
        DocumentError: a matrix has another number of columns than q has elements.
    """
    size = 0 if found["q"] is None else found["q"].size
    for key in MATRICES:
        matrix = found[key]
        if matrix is not None and (matrix.ndim != 2 or matrix.shape[1] != size):
            shape = " x ".join(map(str, matrix.shape)) or "a number"
            message = f"{key} is {shape}, and needs {size} columns, as q is long"
            raise DocumentError(where, message)
    return {key: None if x is None else x.ravel() for key, x in found.items()}
