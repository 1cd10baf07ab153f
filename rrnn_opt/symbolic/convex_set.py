"""What every convex set offers: projection, membership, support, normal cone."""

from __future__ import annotations

from abc import ABC, abstractmethod

from rrnn_opt.symbolic.pointwise import Truth, is_small
from rrnn_opt.symbolic.symbol import Value, require_shape


class ConvexSet(ABC):
    """A closed convex subset of R^n."""

    @property
    @abstractmethod
    def n(self) -> int:
        """Dimension of the space."""

    @abstractmethod
    def project(self, x: Value) -> Value:
        """Nearest point of the set.

        Args:
            x: point, (n, 1) SX or (n,) array.

        Returns:
            ``argmin_{y in C} |y - x|``, in the form of ``x``, (n, 1) or (n,).

        Raises:
            ShapeError: x has another shape.
        """

    @abstractmethod
    def support(self, y: Value) -> Value:
        """Support function ``sup_{x in C} y'x``, a scalar; may be infinite.

        Args:
            y: direction, (n, 1) SX or (n,) array.
        """

    def contains(self, x: Value, *, tolerance: float = 0.0) -> Truth:
        """Whether ``x`` is in the set.

        Args:
            x: point, (n, 1) SX or (n,) array.
            tolerance: allowed distance in every coordinate.

        Returns:
            A bool for an array; for SX an expression that is 1 or 0.
        """
        return is_small(self.project(x) - x, tolerance)

    def normal_cone(self, x: Value, y: Value) -> Value:
        """``P(x + y) - x``: zero iff x is in C and y in the normal cone N_C(x).

        Args:
            x: point, (n, 1) SX or (n,) array.
            y: candidate normal, in the form of ``x``.

        Returns:
            The difference, in the form of ``x``.
        """
        require_shape(x, (self.n, 1), "point")
        require_shape(y, (self.n, 1), "normal")
        return self.project(x + y) - x

    def in_normal_cone(self, x: Value, y: Value, *, tolerance: float = 0.0) -> Truth:
        """Whether x is in C and ``y'(z - x) <= 0`` for all z in C.

        Args:
            x: point, (n, 1) SX or (n,) array.
            y: candidate normal, in the form of ``x``.
            tolerance: allowed size of every element of ``normal_cone(x, y)``.
        """
        return is_small(self.normal_cone(x, y), tolerance)
