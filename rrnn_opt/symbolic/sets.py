"""Closed convex sets with a cheap Euclidean projection, on SX and on numpy.

Every set offers the same four things.  ``project`` returns the nearest point.
``contains`` says whether a point is inside.  ``support`` is the support
function ``sup_{x in C} y'x``.  ``normal_cone`` returns ``P(x + y) - x``, which
is zero exactly when x is in C and y in its normal cone at x.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import accumulate, pairwise

import casadi as ca
import numpy as np

from rrnn_opt.arguments import checked, require_parts
from rrnn_opt.errors import RrnnError, ShapeError
from rrnn_opt.symbolic.convex_set import ConvexSet
from rrnn_opt.symbolic.pointwise import clip, is_symbolic, like
from rrnn_opt.symbolic.symbol import Value, require_shape


@checked(infinite=("lower", "upper"))
@dataclass(frozen=True, eq=False)
class Box(ConvexSet):
    """``{x : lower <= x <= upper}``; a side may be infinite.

    Projection (9): ``min(max(x, lower), upper)``.  Where ``lower > upper`` the
    set is empty and this formula returns ``upper``.

    Attributes:
        lower: (n, 1) SX or (n,) array.
        upper: (n, 1) SX or (n,) array.

    Raises:
        ShapeError: the sides differ in shape, or are no columns.
        RrnnError: both sides are numbers, with none between them somewhere.
    """

    lower: Value
    upper: Value

    def __post_init__(self) -> None:
        require_parts(self.lower, "lower side of the box", ("shape",))
        if not self.lower.shape:
            raise ShapeError("lower side of the box", (1,), ())
        require_shape(self.lower, (self.n, 1), "lower side of the box")
        require_shape(self.upper, (self.n, 1), "upper side of the box")
        if is_symbolic(self.lower) or is_symbolic(self.upper):
            return
        low, high = np.asarray(self.lower), np.asarray(self.upper)
        if not np.all((low <= high) & (low < np.inf) & (high > -np.inf)):
            raise RrnnError(
                "box: it is empty, no number lies between its sides (or one is NaN)"
            )

    @property
    def n(self) -> int:
        """Dimension of the space."""
        return int(self.lower.shape[0])

    def project(self, x: Value) -> Value:
        """Element by element, (9)."""
        require_shape(x, (self.n, 1), "point")
        if is_symbolic(x, self.lower, self.upper):
            return clip(ca.SX(x), ca.SX(self.lower), ca.SX(self.upper))
        return np.minimum(np.maximum(x, like(self.lower, x)), like(self.upper, x))

    def support(self, y: Value) -> Value:
        """``sum max(l y, u y)``, with ``0 * inf = 0``."""
        require_shape(y, (self.n, 1), "direction")
        if is_symbolic(y, self.lower, self.upper):
            y = ca.SX(y)
            above = ca.if_else(y > 0, ca.SX(self.upper), 0)
            return ca.sum1((above + ca.if_else(y < 0, ca.SX(self.lower), 0)) * y)
        low, high = like(self.lower, y), like(self.upper, y)
        side = np.where(y > 0, high, np.where(y < 0, low, 0.0))
        return np.asarray(np.sum(side * y))


@checked()
@dataclass(frozen=True, eq=False)
class Ball(ConvexSet):
    """``{x : |x - center| <= radius}`` with a positive radius.

    Attributes:
        center: (n, 1) SX or (n,) array.
        radius: m, or the unit of x.

    Raises:
        ShapeError: the centre is no column.
        RrnnError: the radius is not positive.
    """

    center: Value
    radius: float

    def __post_init__(self) -> None:
        require_shape(self.center, (self.n, 1), "center of the ball")
        if not self.radius > 0.0:
            raise RrnnError("ball: the radius must be positive")

    @property
    def n(self) -> int:
        """Dimension of the space."""
        return int(self.center.shape[0])

    def project(self, x: Value) -> Value:
        """``center + (x - center) r / max(r, |x - center|)``."""
        require_shape(x, (self.n, 1), "point")
        if is_symbolic(x, self.center):
            away = ca.SX(x) - ca.SX(self.center)
            shrink = self.radius / ca.fmax(self.radius, ca.norm_2(away))
            return ca.SX(self.center) + away * shrink
        center = like(self.center, x)
        length = float(np.linalg.norm(x - center))
        return center + (x - center) * (self.radius / max(self.radius, length))

    def support(self, y: Value) -> Value:
        """``center'y + radius |y|``."""
        require_shape(y, (self.n, 1), "direction")
        if is_symbolic(y, self.center):
            y = ca.SX(y)
            return ca.dot(ca.SX(self.center), y) + self.radius * ca.norm_2(y)
        inner = np.sum(like(self.center, y) * y)
        return np.asarray(inner + self.radius * np.linalg.norm(y))


@checked()
@dataclass(frozen=True)
class Orthant(ConvexSet):
    """The nonnegative orthant ``{x : x >= 0}``.

    Attributes:
        dimension: n, number of coordinates.
    """

    dimension: int

    @property
    def n(self) -> int:
        """Dimension of the space."""
        return self.dimension

    def project(self, x: Value) -> Value:
        """``max(x, 0)``, element by element."""
        return self._box.project(x)

    def support(self, y: Value) -> Value:
        """0 where ``y <= 0``, else infinite."""
        return self._box.support(y)

    @property
    def _box(self) -> Box:
        return Box(np.zeros(self.n), np.full(self.n, np.inf))


def whole_space(n: int) -> Box:
    """All of R^n: ``P(x) = x``."""
    return Box(np.full(n, -np.inf), np.full(n, np.inf))


@checked()
@dataclass(frozen=True, eq=False)
class Product(ConvexSet):
    """Cartesian product ``C_1 x C_2 x ..`` of sets, coordinates stacked.

    Attributes:
        factors: the sets.
    """

    factors: tuple[ConvexSet, ...]

    @property
    def n(self) -> int:
        """Dimension of the space."""
        return sum(f.n for f in self.factors)

    def project(self, x: Value) -> Value:
        """Factor by factor."""
        parts = self._split(x, "point")
        done = [f.project(part) for f, part in zip(self.factors, parts, strict=True)]
        return ca.vertcat(*done) if is_symbolic(*done) else np.concatenate(done)

    def support(self, y: Value) -> Value:
        """Sum of the factors' support functions."""
        parts = self._split(y, "direction")
        values = [f.support(part) for f, part in zip(self.factors, parts, strict=True)]
        return sum(values[1:], start=values[0])

    def _split(self, x: Value, name: str) -> list[Value]:
        require_shape(x, (self.n, 1), name)
        ends = [0, *accumulate(f.n for f in self.factors)]
        return [x[a:b] for a, b in pairwise(ends)]
