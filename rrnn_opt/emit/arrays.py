"""Addresses of numpy arrays, checked before C sees them; nothing is copied."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Any

import numpy as np

from rrnn_opt.errors import LayoutError, ShapeError
from rrnn_opt.symbolic.tape import Port

Array = np.ndarray[Any, np.dtype[Any]]
_from_buffer = ctypes.c_char.from_buffer
_addressof = ctypes.addressof


@dataclass(frozen=True, slots=True)
class Slot:
    """One argument or result of a compiled function.

    Attributes:
        name: its name.
        rows: rows of the dense matrix.
        columns: its columns.
        dtype: float64 or float32.
        shapes: shapes that are accepted; the first is the one returned.
    """

    name: str
    rows: int
    columns: int
    dtype: np.dtype[Any]
    shapes: tuple[tuple[int, ...], ...]

    @staticmethod
    def of(port: Port, dtype: np.dtype[Any]) -> Slot:
        """Columns are one-dimensional arrays, everything else is a matrix."""
        rows, columns = port.shape
        shapes: list[tuple[int, ...]] = [port.shape]
        if columns == 1:
            shapes.insert(0, (rows,))
        if port.shape == (1, 1):
            shapes.append(())
        return Slot(port.name, rows, columns, dtype, tuple(shapes))

    @property
    def size(self) -> int:
        """Number of elements."""
        return self.rows * self.columns

    def new(self) -> Array:
        """Uninitialised array for this result."""
        return np.empty(self.shapes[0], self.dtype, "F")

    def address(self, array: Array) -> int:
        """Address of one value of this slot.

        Raises:
            ShapeError: wrong shape; as LayoutError: wrong type or order.
        """
        try:
            if (
                array.dtype is not self.dtype
                or array.shape not in self.shapes
                or not array.flags.f_contiguous
            ):
                self._refuse(array)
        except AttributeError:  # not an array at all
            self._refuse(array)
        return address_of(array if self.columns == 1 else array.T)

    def result(self, array: Array) -> int:
        """As :meth:`address`, for memory that is written.

        Raises:
            ShapeError: wrong shape.
            LayoutError: wrong type or order, or not writeable.
        """
        address = self.address(array)
        if not array.flags.writeable:
            raise LayoutError(self.name, array.shape, "pass a writeable array")
        return address

    def _refuse(self, array: Array) -> None:
        """Say what is wrong with an array, if anything is."""
        if not isinstance(array, np.ndarray) or array.shape not in self.shapes:
            raise ShapeError(self.name, self.shapes[0], _shape(array))
        if array.dtype != self.dtype:
            raise LayoutError(self.name, array.shape, f"pass dtype {self.dtype}")
        if not array.flags.f_contiguous:
            advice = "pass contiguous column-major memory (np.asfortranarray)"
            raise LayoutError(self.name, array.shape, advice)

    def batch(self, array: Array, count: int) -> tuple[int, int]:
        """Address and row stride [elements] of ``count`` values in a row.

        An array that has the shape of one value stands for all rows (stride 0).

        Raises:
            ShapeError: neither the shape of one value nor that of all rows.
            LayoutError: wrong type or memory order.
        """
        if _shape(array) in self.shapes:
            return self.address(array), 0
        wanted = {(count, *shape) for shape in self.shapes}
        if type(array) is not np.ndarray or array.shape not in wanted:
            raise ShapeError(self.name, (count, *self.shapes[0]), _shape(array))
        if array.dtype != self.dtype:
            raise LayoutError(self.name, array.shape, f"pass dtype {self.dtype}")
        flat = array.swapaxes(1, 2) if array.ndim == 3 else array
        if not flat.flags.c_contiguous:
            advice = "pass contiguous rows, each matrix column-major"
            raise LayoutError(self.name, array.shape, advice)
        return address_of(flat), self.size

    def new_batch(self, count: int) -> Array:
        """Uninitialised results of ``count`` calls, each column-major."""
        if len(self.shapes[0]) == 1:
            return np.empty((count, self.rows), self.dtype)
        return np.empty((count, self.columns, self.rows), self.dtype).swapaxes(1, 2)


def _shape(value: Any) -> tuple[int, ...]:
    """The shape of an array; none for what has no shape."""
    try:
        return np.shape(value)
    except (ValueError, TypeError):
        return ()


def address_of(array: Array) -> int:
    """Address of a C-contiguous array; the buffer protocol is the fast way."""
    try:
        return _addressof(_from_buffer(array))  # type: ignore[arg-type]
    except (TypeError, ValueError):  # read-only or empty
        return int(array.ctypes.data)
