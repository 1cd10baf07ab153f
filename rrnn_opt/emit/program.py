"""Symbolic functions as one compiled program that numpy arrays go through."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import casadi as ca
import numpy as np

from rrnn_opt.arguments import checked
from rrnn_opt.emit.arrays import Array, Slot, address_of
from rrnn_opt.emit.c99 import c_function, require_identifier
from rrnn_opt.emit.host import Built, build, load
from rrnn_opt.emit.prologue import Real, prologue
from rrnn_opt.errors import ArgumentError, RrnnError, ShapeError
from rrnn_opt.symbolic.tape import Tape

_MAP = """\
RRNN_EXPORT void {c}_map(size_t n, const real_t *const *in, const size_t *step,
                         real_t *const *out);
void {c}_map(size_t n, const real_t *const *in, const size_t *step,
             real_t *const *out)
{{
    size_t k;
    (void)in;
    (void)step;
    (void)out;
    for (k = 0; k < n; ++k) {{
        {c}({args});
    }}
}}
"""


@dataclass(frozen=True, slots=True)
class Entry:
    """One function of a program: its slots and its two C entry points."""

    inputs: tuple[Slot, ...]
    outputs: tuple[Slot, ...]
    one: Callable[..., None]
    many: Callable[..., None]


@dataclass(frozen=True, slots=True)
class Program:
    """Compiled functions; made by :func:`compile`.

    Attributes:
        name: prefix of its C names.
        source: the C99 text.
        built: where the shared object is, and whether it was compiled now.
        entries: its functions by name.
    """

    name: str
    source: str
    built: Built
    entries: dict[str, Entry]

    def call(
        self, name: str, *arrays: Array, out: Sequence[Array] | None = None
    ) -> tuple[Array, ...]:
        """Evaluate one function.

        Args:
            name: of the function.
            arrays: one for each argument, column-major, of the program's type;
                a column (n, 1) is an array (n,). Nothing is copied.
            out: arrays in the shape of the results; new ones by default.

        Returns:
            One array for each result, (rows, columns), or (n,) for a column.

        Raises:
            ShapeError: wrong number, shape, type or memory order of arrays.
            RrnnError: there is no such function.
        """
        entry = self._entry(name)
        sources = _addresses(name, entry, arrays)
        if out is not None:
            entry.one(*sources, *_targets(name, entry, out))
            return tuple(out)
        results = tuple([slot.new() for slot in entry.outputs])
        entry.one(*sources, *[address_of(array.T) for array in results])
        return results

    def bind(
        self, name: str, *arrays: Array, out: Sequence[Array]
    ) -> Callable[[], None]:
        """Check once, call often: a function of nothing for tight Python loops.

        Args:
            name: of the function.
            arrays: as in :meth:`call`; read anew at every call.
            out: arrays that every call writes, in the shape of the results.

        Returns:
            A function that runs the compiled code on exactly these arrays and
            keeps them alive.

        Raises:
            ShapeError: wrong number, shape, type or memory order of arrays.
            RrnnError: there is no such function.
        """
        entry = self._entry(name)
        where = (*_addresses(name, entry, arrays), *_targets(name, entry, out))
        one, kept = entry.one, (arrays, tuple(out))

        def run(_kept: object = kept) -> None:
            one(*where)

        return run

    def map(self, name: str, *arrays: Array, n: int) -> tuple[Array, ...]:
        """Evaluate one function on ``n`` rows, in one C loop.

        Args:
            name: of the function.
            arrays: one for each argument, shape (n, size) or (n, rows, columns)
                with each matrix column-major; an array of the shape of a single
                value is used for all rows. Nothing is copied.
            n: number of rows.

        Returns:
            One array for each result, shape (n, size) or (n, rows, columns).

        Raises:
            ShapeError: wrong number, shape, type or memory order of arrays.
            RrnnError: there is no such function.
        """
        entry = self._entry(name)
        _require_count(f"{name}: arrays", entry.inputs, arrays)
        if not isinstance(n, int | np.integer) or n < 0:
            raise ArgumentError(f"{name}: n", "expected a number of rows")
        pairs = zip(entry.inputs, arrays, strict=True)
        where = [slot.batch(array, n) for slot, array in pairs]
        results = tuple(slot.new_batch(n) for slot in entry.outputs)
        written = zip(entry.outputs, results, strict=True)
        pointer, size = ctypes.c_void_p, ctypes.c_size_t
        entry.many(
            n,
            (pointer * len(where))(*[address for address, _ in where]),
            (size * len(where))(*[step for _, step in where]),
            (pointer * len(results))(*[slot.batch(a, n)[0] for slot, a in written]),
        )
        return results

    def _entry(self, name: str) -> Entry:
        try:
            return self.entries[name]
        except (KeyError, TypeError):
            known = ", ".join(self.entries)
            raise RrnnError(f"program has no '{name}'; it has {known}") from None


def _require_count(what: str, slots: Sequence[Slot], arrays: Sequence[Array]) -> None:
    given = len(arrays) if isinstance(arrays, list | tuple) else 0
    if given != len(slots):
        raise ShapeError(what, (len(slots),), (given,))


def _addresses(name: str, entry: Entry, arrays: Sequence[Array]) -> list[int]:
    _require_count(f"{name}: arrays", entry.inputs, arrays)
    return [s.address(a) for s, a in zip(entry.inputs, arrays, strict=True)]


def _targets(name: str, entry: Entry, out: Sequence[Array]) -> list[int]:
    _require_count(f"{name}: out", entry.outputs, out)
    return [s.result(a) for s, a in zip(entry.outputs, out, strict=True)]


@checked()
def compile(
    functions: ca.Function | Sequence[ca.Function],
    *,
    name: str | None = None,
    real: Real = "double",
    flags: Sequence[str] = (),
) -> Program:
    """Emit, compile (or find compiled) and load one program.

    Args:
        functions: one or several, with different names.
        name: prefix of the C names; the first function's name by default.
        real: C type of all numbers.
        flags: for the compiler, after its own.

    Raises:
        CompilerError: no compiler, or it failed.
        UnsupportedOperationError: a graph holds an operation without C text.
        RrnnError: no function, two of one name, or a name that C does not accept.
    """
    several = [functions] if isinstance(functions, ca.Function) else list(functions)
    if not several:
        raise RrnnError("a program needs at least one function")
    tapes = {fn.name(): Tape.of(fn) for fn in several}
    if len(tapes) != len(several):
        raise RrnnError("the functions of a program need different names")
    prefix = require_identifier(name or several[0].name())
    source = program_source(tapes, prefix, real=real)
    built = build(source, name=prefix, flags=flags)
    return Program(prefix, source, built, _entries(load(built), tapes, prefix, real))


def program_source(tapes: dict[str, Tape], prefix: str, *, real: Real) -> str:
    """Translation unit with every function and its loop over rows."""
    parts = [prologue(real)]
    for fn_name, tape in tapes.items():
        c_name = f"{prefix}_{fn_name}"
        parts.append(c_function(tape, c_name, real=real, static=False))
        reads = [f"in[{i}] + k * step[{i}]" for i in range(len(tape.inputs))]
        writes = [
            f"out[{i}] + k * (size_t){port.size}" for i, port in enumerate(tape.outputs)
        ]
        parts.append(_MAP.format(c=c_name, args=", ".join([*reads, *writes])))
    return "\n".join(parts)


def _entries(
    library: ctypes.CDLL, tapes: dict[str, Tape], prefix: str, real: Real
) -> dict[str, Entry]:
    dtype = np.dtype(np.float32 if real == "float" else np.float64)
    entries: dict[str, Entry] = {}
    for fn_name, tape in tapes.items():
        one = library[f"{prefix}_{fn_name}"]
        many = library[f"{prefix}_{fn_name}_map"]
        count = len(tape.inputs) + len(tape.outputs)
        one.restype = many.restype = None
        one.argtypes = (ctypes.c_void_p,) * count
        many.argtypes = (ctypes.c_size_t, *(ctypes.c_void_p,) * 3)
        entries[fn_name] = Entry(
            tuple(Slot.of(port, dtype) for port in tape.inputs),
            tuple(Slot.of(port, dtype) for port in tape.outputs),
            one,
            many,
        )
    return entries
