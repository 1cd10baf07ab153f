"""One symbolic function on many columns of numbers, as many at once as lanes."""

from __future__ import annotations

import ctypes
import platform
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from rrnn_opt.arguments import checked, require_numeric
from rrnn_opt.emit.arrays import Array
from rrnn_opt.emit.c99 import require_identifier
from rrnn_opt.emit.columns import (
    columns_of,
    padded,
    require_room,
    room_of,
    rows_of,
    wide_of,
)
from rrnn_opt.emit.compiler import find_compiler
from rrnn_opt.emit.host import Built, build, load
from rrnn_opt.emit.lanes import FLAGS, PORTABLE, WIDTHS, lanes_source
from rrnn_opt.errors import RrnnError, ShapeError
from rrnn_opt.symbolic.tape import Port, Tape


@dataclass(frozen=True, slots=True)
class Batch:
    """A compiled function of columns; made by :func:`compile_batch`.

    Attributes:
        name: of the function.
        source: the C text.
        built: where the shared object is, and whether it was compiled now.
        inputs: name and shape of one value of each argument.
        outputs: the same of each result.
        lanes: columns that are worked out at once.
        kernel: the C entry point.
    """

    name: str
    source: str
    built: Built
    inputs: tuple[Port, ...]
    outputs: tuple[Port, ...]
    lanes: int
    kernel: Callable[..., None]

    def __call__(
        self, *arrays: Array, out: Sequence[Array] | None = None
    ) -> tuple[Array, ...]:
        """Evaluate the function on every column.

        Args:
            arrays: one for each argument, (rows, n), or (rows, columns, n) for a
                matrix.  An array of the shape of a single value, (rows,) or
                (rows, columns), is used for all columns.  Contiguous rows of
                float64 are read where they are when n is a multiple of 8,
                everything else is copied first.
            out: of the shape of :meth:`room`, to be written again; new ones by
                default.

        Returns:
            One array for each result, (rows, n) or (rows, columns, n).

        Raises:
            ShapeError: wrong number or shape of arrays; as LayoutError: ``out``
                is not from :meth:`room`, or shares memory with an argument.
            RrnnError: every argument is a single value.
        """
        run, results = self.bind(*arrays, out=out)
        run()
        return results

    def bind(
        self, *arrays: Array, out: Sequence[Array] | None = None
    ) -> tuple[Callable[[], None], tuple[Array, ...]]:
        """Check once, evaluate often: a call without arguments, and its results.

        Arrays that are read where they are may change between evaluations; those
        that had to be copied keep the numbers of now.

        Args:
            *arrays: as in a call, one for each argument.
            out: of the shape of :meth:`room`, written at every evaluation; new
                ones by default.

        Raises:
            ShapeError: wrong number or shape of arrays; as LayoutError: ``out``
                is not from :meth:`room`, or shares memory with an argument.
            RrnnError: every argument is a single value.
        """
        for k, array in enumerate(arrays):
            require_numeric(array, f"{self.name}: array {k}")
        given = [np.asarray(a, np.float64) for a in arrays]
        n = columns_of(self.name, self.inputs, given)
        pairs = zip(self.inputs, given, strict=True)
        read = [rows_of(port, array, n) for port, array in pairs]
        results = self.room(n) if out is None else _rooms(out)
        if len(results) != len(self.outputs):
            raise ShapeError(f"{self.name}: out", (len(self.outputs),), (len(results),))
        for port, result in zip(self.outputs, results, strict=True):
            require_room(port, result, n, read)
        pointer, size = ctypes.c_void_p, ctypes.c_size_t
        kernel = self.kernel
        where = (
            self.lanes,
            padded(n),
            (pointer * len(read))(*[rows.address for rows in read]),
            (size * len(read))(*[rows.row for rows in read]),
            (size * len(read))(*[rows.step for rows in read]),
            (pointer * len(results))(*[result.ctypes.data for result in results]),
            wide_of(n),
        )

        def run(_kept: object = (read, results)) -> None:
            kernel(*where)

        return run, results

    def room(self, n: int) -> tuple[Array, ...]:
        """Uninitialised results, (rows, n) or (rows, columns, n), to be used again."""
        return tuple(room_of(port, n) for port in self.outputs)


def _rooms(out: Any) -> tuple[Array, ...]:
    """The results that a caller brings; none where it brings something else."""
    return tuple(out) if isinstance(out, list | tuple) else ()


@checked()
def compile_batch(
    fn: ca.Function, *, lanes: int | None = None, fused: bool = False
) -> Batch:
    """Emit, compile (or find compiled) and load one function of columns.

    The shared object holds the function for 8, 4 and 2 columns at once and asks
    the processor which of them it can run.  Each column gets the bits that
    :func:`rrnn_opt.emit.compile` computes for it.

    Args:
        fn: SX or MX function.
        lanes: 8 (AVX-512), 4 (AVX2) or 2; the most that the processor can by
            default.
        fused: let a product and a sum become one instruction where there is
            one, rounded once; faster, and the last bits then depend on lanes.

    Raises:
        CompilerError: no compiler, or it failed.
        UnsupportedOperationError: the graph holds an operation without C text.
        RrnnError: the processor cannot work on so many lanes.
    """
    tape = Tape.of(fn)
    name = require_identifier(fn.name())
    source = lanes_source(tape, name)
    built = build(source, name=f"{name}_batch", flags=_flags(fused))
    library = load(built)
    widest = int(library[f"{name}_lanes"]())
    chosen = widest if lanes is None else lanes
    if chosen > widest or chosen not in (*WIDTHS, PORTABLE):
        fit = [k for k in (*WIDTHS, PORTABLE) if k <= widest]
        raise RrnnError(f"{name}: lanes must be one of {fit} here, got {chosen}")
    kernel, size = library[name], ctypes.c_size_t
    kernel.argtypes = (ctypes.c_int, size, *(ctypes.c_void_p,) * 4, size)
    kernel.restype = None
    return Batch(name, source, built, tape.inputs, tape.outputs, chosen, kernel)


def _flags(fused: bool) -> tuple[str, ...]:
    """No extension outside the kernels that ask for it, so all x86-64 can run it."""
    contract = ("-ffp-contract=fast",) if fused else ()
    if platform.machine() not in ("x86_64", "AMD64"):
        return (*FLAGS, *contract)
    name = "x86_64" if find_compiler().kind == "zig" else "x86-64"
    return (*FLAGS, f"-march={name}", *contract)
