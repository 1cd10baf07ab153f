"""Arrays whose last axis counts calls, laid out for kernels over lanes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rrnn_opt.emit.arrays import Array
from rrnn_opt.emit.lanes import BLOCK
from rrnn_opt.errors import LayoutError, RrnnError, ShapeError
from rrnn_opt.symbolic.tape import Port

_PAGE = 512
"""Rows whose starts are a page apart share their places in the first cache."""


@dataclass(frozen=True, slots=True)
class Rows:
    """What a kernel reads of one argument; one row is one element.

    Attributes:
        kept: the memory.
        address: of element 0 in column 0.
        row: numbers from one element to the next.
        step: numbers from one column to the next, 0 for the same in all.
    """

    kept: Array
    address: int
    row: int
    step: int


def shape_of(port: Port) -> tuple[int, ...]:
    """Shape of one value: (rows,) or (rows, columns)."""
    return port.shape if port.shape[1] != 1 else port.shape[:1]


def padded(n: int) -> int:
    """Columns that a kernel writes: ``n`` up to whole blocks."""
    return -(-n // BLOCK) * BLOCK


def columns_of(name: str, ports: Sequence[Port], arrays: Sequence[Array]) -> int:
    """Number of columns on which all arguments agree.

    Raises:
        ShapeError: wrong number or shape of arrays, or different numbers.
        RrnnError: every argument is a single value.
    """
    if len(arrays) != len(ports):
        raise ShapeError(f"{name}: arrays", (len(ports),), (len(arrays),))
    n: int | None = None
    for port, array in zip(ports, arrays, strict=True):
        single = shape_of(port)
        if array.shape == single:
            continue
        last = array.shape[-1] if n is None and array.ndim else n or 0
        if array.shape != (*single, last):
            raise ShapeError(port.name, (*single, last), array.shape)
        n = last
    if n is None:
        raise RrnnError(f"{name}: no argument has columns; give one the shape (.., n)")
    return n


def rows_of(port: Port, array: Array, n: int) -> Rows:
    """An argument as a kernel reads it; copied unless it lies there so already."""
    if array.shape == shape_of(port):
        value = array.T.reshape(port.size, 1)
        kept = np.ascontiguousarray(np.broadcast_to(value, (port.size, BLOCK)))
        return Rows(kept, kept.ctypes.data, BLOCK, 0)
    element_first = array.swapaxes(0, 1) if array.ndim == 3 else array
    flat = element_first.reshape(port.size, n)
    if n % BLOCK or not flat.flags.c_contiguous:
        room = np.empty((port.size, padded(n)))
        room[:, :n] = flat
        room[:, n:] = flat[:, -1:] if n else 0.0
        flat = room
    return Rows(flat, flat.ctypes.data, flat.shape[1], 1)


def wide_of(n: int) -> int:
    """Numbers from one element of a result to the next."""
    return padded(n) + (BLOCK if padded(n) % _PAGE == 0 else 0)


def room_of(port: Port, n: int) -> Array:
    """Uninitialised result, each element a row that whole blocks fit into."""
    rows, columns = port.shape
    if columns == 1:
        return np.empty((rows, wide_of(n)))[:, :n]
    return np.empty((columns, rows, wide_of(n)))[:, :, :n].swapaxes(0, 1)


def require_room(port: Port, array: Array, n: int, read: Sequence[Rows]) -> None:
    """Refuse memory that a kernel cannot write, or that it reads.

    Raises:
        ShapeError: wrong shape; as LayoutError: not made by :func:`room_of`, or
            it shares memory with an argument.
    """
    want = (*shape_of(port), n)
    if not isinstance(array, np.ndarray) or array.shape != want:
        raise ShapeError(port.name, want, np.shape(array))
    row = 8 * wide_of(n)
    strides = (row, 8) if len(want) == 2 else (row, port.shape[0] * row, 8)
    lies = array.strides == strides and array.dtype == np.float64
    if array.size and not (lies and array.flags.writeable):
        advice = f"pass the arrays of Batch.room({n})"
        raise LayoutError(port.name, array.shape, advice)
    if any(np.may_share_memory(array, rows.kept) for rows in read):
        advice = "pass results that share no memory with arguments"
        raise LayoutError(port.name, array.shape, advice)
