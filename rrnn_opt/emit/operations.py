"""C text of every operation of a tape."""

from __future__ import annotations

from rrnn_opt.symbolic.tape import OPERATIONS

# {0}, {1}: operands; {zero}, {one}: typed literals; {f}: "f" for float.
C_TEXT: dict[str, str] = {
    "add": "{0} + {1}",
    "sub": "{0} - {1}",
    "mul": "{0} * {1}",
    "div": "{0} / {1}",
    "neg": "-{0}",
    "sq": "{0} * {0}",
    "twice": "{0} + {0}",
    "inv": "{one} / {0}",
    "sqrt": "sqrt{f}({0})",
    "fabs": "fabs{f}({0})",
    "sign": "({0} < {zero}) ? -{one} : (({0} > {zero}) ? {one} : {0})",
    "floor": "floor{f}({0})",
    "ceil": "ceil{f}({0})",
    "copysign": "copysign{f}({0}, {1})",
    "fmin": "({0} < {1}) ? {0} : {1}",
    "fmax": "({0} > {1}) ? {0} : {1}",
    "lt": "({0} < {1}) ? {one} : {zero}",
    "le": "({0} <= {1}) ? {one} : {zero}",
    "eq": "({0} == {1}) ? {one} : {zero}",
    "ne": "({0} != {1}) ? {one} : {zero}",
    "not": "({0} == {zero}) ? {one} : {zero}",
    "and": "(({0} != {zero}) && ({1} != {zero})) ? {one} : {zero}",
    "or": "(({0} != {zero}) || ({1} != {zero})) ? {one} : {zero}",
    "if_else_zero": "({0} != {zero}) ? {1} : {zero}",
}
LIBRARY = tuple(row.name for row in OPERATIONS.values() if not row.exact)
"""Operations left to the C library of the host."""
C_TEXT |= {name: f"{name}{{f}}({{0}})" for name in LIBRARY}
C_TEXT |= {name: f"{name}{{f}}({{0}}, {{1}})" for name in ("pow", "atan2", "hypot")}
