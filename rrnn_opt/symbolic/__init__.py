"""Symbols, convex sets and the taking apart of a declaration; pure, on CasADi SX."""

from rrnn_opt.symbolic.symbol import (
    Symbol,
    dense,
    require_declared,
    require_names,
    require_shape,
    shape_of,
)

__all__ = [
    "Symbol",
    "dense",
    "require_declared",
    "require_names",
    "require_shape",
    "shape_of",
]
