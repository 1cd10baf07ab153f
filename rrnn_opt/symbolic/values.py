"""Numbers for symbols: names, shapes and finiteness are checked here."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rrnn_opt.arguments import require_numeric
from rrnn_opt.errors import NotFiniteError, RrnnError
from rrnn_opt.symbolic.symbol import Symbol, require_shape

Array = NDArray[np.float64]


def number(symbol: Symbol, value: ArrayLike) -> Array:
    """``value`` as a float array of the symbol's shape.

    Args:
        symbol: what the value is for.
        value: an array of exactly the symbol's shape; (n,) will do for (n, 1),
            and a plain number for (1, 1).

    Returns:
        Array of shape ``symbol.shape``, column-major.

    Raises:
        ShapeError: it has another shape.
        NotFiniteError: it holds NaN or an infinity.
        ArgumentError: it holds no real numbers.
    """
    require_numeric(value, symbol.name)
    array = np.asarray(value, dtype=np.float64)
    if array.ndim == 0:
        array = array.reshape(1, 1)
    require_shape(array, symbol.shape, symbol.name)
    if not np.all(np.isfinite(array)):
        raise NotFiniteError(symbol.name)
    return np.asfortranarray(array.reshape(symbol.shape))


def arguments(
    symbols: tuple[Symbol, ...], given: Mapping[str, ArrayLike], where: str
) -> list[Array]:
    """Numbers for all ``symbols``, in their order, each in the shape of its symbol.

    Args:
        symbols: what is wanted.
        given: numbers by name.
        where: who asks, for the message.

    Raises:
        RrnnError: a name is missing or unknown.
        ShapeError: a value has the wrong shape.
        NotFiniteError: a value holds NaN or an infinity.
    """
    names = [s.name for s in symbols]
    missing = [name for name in names if name not in given]
    unknown = [name for name in given if name not in names]
    if missing or unknown:
        wrong = [f"'{n}' is missing" for n in missing]
        wrong += [f"'{n}' is unknown" for n in unknown]
        wanted = ", ".join(names) or "none"
        raise RrnnError(f"{where}: {', '.join(wrong)}; parameters are {wanted}")
    return [number(s, given[s.name]) for s in symbols]
