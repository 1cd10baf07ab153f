"""Symbols, convex sets and the taking apart of a declaration; pure, on CasADi SX."""

from rrnn_opt.symbolic.convex_set import ConvexSet
from rrnn_opt.symbolic.degree import require_degree
from rrnn_opt.symbolic.lagrangian import Lagrangian
from rrnn_opt.symbolic.qp import QP
from rrnn_opt.symbolic.sets import (
    Ball,
    Box,
    Orthant,
    Product,
    whole_space,
)
from rrnn_opt.symbolic.symbol import (
    Symbol,
    dense,
    require_declared,
    require_names,
    require_shape,
    shape_of,
)
from rrnn_opt.symbolic.tape import Instruction, Tape, fingerprint
from rrnn_opt.symbolic.values import arguments, number

__all__ = [
    "QP",
    "Ball",
    "Box",
    "ConvexSet",
    "Instruction",
    "Lagrangian",
    "Orthant",
    "Product",
    "Symbol",
    "Tape",
    "arguments",
    "dense",
    "fingerprint",
    "number",
    "require_declared",
    "require_degree",
    "require_names",
    "require_shape",
    "shape_of",
    "whole_space",
]
