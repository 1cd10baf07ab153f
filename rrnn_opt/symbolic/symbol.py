"""Named symbols, and the one place where shapes are checked."""

from __future__ import annotations

import re
from dataclasses import dataclass

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from rrnn_opt.arguments import checked, require_numeric, require_parts
from rrnn_opt.errors import ArgumentError, RrnnError, ShapeError

Expr = ca.SX
Value = ca.SX | NDArray[np.float64]
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*\Z")


def shape_of(value: Value) -> tuple[int, int]:
    """Rows and columns of an expression or array; an array (n,) is (n, 1).

    Args:
        value: SX or array of any shape of at most two dimensions.

    Raises:
        ArgumentError: it is neither, or a single number.
    """
    require_parts(value, "expression", ("shape",))
    shape = tuple(int(n) for n in value.shape)
    if not shape:
        raise ArgumentError("expression", "expected rows, got a single number")
    return (shape[0], 1) if len(shape) == 1 else shape  # type: ignore[return-value]


def require_shape(value: Value, shape: tuple[int, int], name: str) -> None:
    """Refuse an expression or array of another shape.

    CasADi repeats a scalar wherever a matrix is wanted, and accepts a row for
    a column in places.  Nothing in this package relies on that: every
    constructor calls this function.

    Args:
        value: SX or array of any shape; a 1-d array counts as a column.
        shape: required (rows, columns).
        name: what the value is, for the message.

    Raises:
        ShapeError: the shape differs.
    """
    require_parts(value, name, ("shape",))
    kind = getattr(getattr(value, "dtype", None), "kind", "")
    if kind not in tuple("biuf") and not isinstance(value, ca.SX | ca.DM | ca.MX):
        require_numeric(value, name)
    got = tuple(int(n) for n in value.shape)
    if got != shape and not (len(got) == 1 and (got[0], 1) == shape):
        raise ShapeError(name, shape, got)


def dense(value: Value, shape: tuple[int, int], name: str) -> ca.SX:
    """``value`` as a dense SX expression of ``shape``.

    Args:
        value: SX, DM or array of any shape; other shapes than asked are refused.
        shape: required (rows, columns).
        name: what the value is, for the message.

    Raises:
        ShapeError: the shape differs.
    """
    if not isinstance(value, (ca.SX, ca.DM)):
        require_numeric(value, name)
        value = np.asarray(value, dtype=np.float64)
    require_shape(value, shape, name)
    return ca.densify(ca.SX(value))


@checked()
@dataclass(frozen=True, eq=False)
class Symbol:
    """A named free variable: C argument names and tables come from it.

    Attributes:
        name: a C identifier.
        sx: the CasADi symbol, dense, of any shape.
        unit: SI unit, e.g. "rad/s"; "1" when there is none.
        meaning: half a sentence for the documentation.

    Raises:
        RrnnError: the name is no C identifier, or ``sx`` is not purely symbolic.
    """

    name: str
    sx: ca.SX
    unit: str = "1"
    meaning: str = ""

    def __post_init__(self) -> None:
        if not _NAME.match(self.name):
            raise RrnnError(f"symbol '{self.name}': use a C identifier as its name")
        if not (isinstance(self.sx, ca.SX) and self.sx.is_valid_input()):
            raise RrnnError(f"symbol '{self.name}': give ca.SX.sym, not an expression")

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return shape_of(self.sx)

    @property
    def size(self) -> int:
        """Number of elements."""
        return int(self.sx.numel())

    @staticmethod
    def vector(name: str, n: int, unit: str = "1", meaning: str = "") -> Symbol:
        """A fresh column of ``n`` elements.

        Args:
            name: its name in C, tables and errors.
            n: number of elements.
            unit: SI, of every element.
            meaning: half a sentence for tables.
        """
        return Symbol(name, ca.SX.sym(name, n), unit, meaning)

    @staticmethod
    def matrix(
        name: str, shape: tuple[int, int], unit: str = "1", meaning: str = ""
    ) -> Symbol:
        """A fresh dense matrix of ``shape`` (rows, columns).

        Args:
            name: its name in C, tables and errors.
            shape: rows and columns.
            unit: SI, of every element.
            meaning: half a sentence for tables.
        """
        return Symbol(name, ca.SX.sym(name, *shape), unit, meaning)

    @staticmethod
    def scalar(name: str, unit: str = "1", meaning: str = "") -> Symbol:
        """A fresh scalar.

        Args:
            name: its name in C, tables and errors.
            unit: SI, e.g. "rad/s"; "1" without one.
            meaning: half a sentence for tables.
        """
        return Symbol(name, ca.SX.sym(name), unit, meaning)


def require_names(symbols: tuple[Symbol, ...], where: str) -> None:
    """Refuse two symbols of one name, or of one variable.

    Args:
        symbols: those of one declaration.
        where: whose they are, for the error.

    Raises:
        RrnnError: a name stands twice, or a variable under two names.
    """
    for symbol in symbols:
        require_parts(symbol, where, ("name", "sx"))
    names = [s.name for s in symbols]
    for name in names:
        if names.count(name) > 1:
            raise RrnnError(f"{where}: two symbols are called '{name}'; rename one")
    owner: dict[int, str] = {}
    for symbol in symbols:
        for x in ca.vertsplit(ca.vec(symbol.sx)):
            other = owner.setdefault(x.element_hash(), symbol.name)
            if other != symbol.name:
                raise RrnnError(
                    f"{where}: '{other}' and '{symbol.name}' are one variable, {x}"
                )


def require_declared(expr: ca.SX, symbols: tuple[Symbol, ...], name: str) -> None:
    """Refuse an expression with a free variable that no symbol declares.

    Args:
        expr: SX of any shape.
        symbols: what it may depend on.
        name: what the expression is, for the message.

    Raises:
        RrnnError: it depends on something else; the message names it.
    """
    elements = [ca.vertsplit(ca.vec(s.sx)) for s in symbols]
    known = {x.element_hash() for column in elements for x in column}
    free = [v for v in ca.symvar(expr) if v.element_hash() not in known]
    if free:
        listed = ", ".join(sorted({str(v) for v in free}))
        raise RrnnError(f"{name}: depends on {listed}; declare it as a parameter")
