"""Two enclosures of a function over boxes: natural and mean-value form.

Natural: every operation on intervals.  Mean value: with c the middle of a box
X and G an enclosure of the Jacobian over X,

    f(x) in f(c) + G (x - c)   for every x in X

(A. Neumaier, "Interval Methods for Systems of Equations", 1990, section 2.3).
It holds for Lipschitz functions too, G containing every generalised gradient;
minimum, maximum and absolute value may occur, jumps may not.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import casadi as ca
import numpy as np

from rrnn_opt.errors import UnsupportedOperationError
from rrnn_opt.symbolic.tape import Tape
from rrnn_opt.verification.engines.interval.kernel import (
    Array,
    Enclosure,
    IntervalKernel,
)

_EXACT = ("input", "output", "const", "add", "sub", "mul", "neg", "sq", "twice")
CONTINUOUS = frozenset(
    (*_EXACT, "div", "inv", "sqrt", "sin", "cos", "fabs", "fmin", "fmax", "pow")
)
"""Operations that are Lipschitz wherever their enclosure is bounded."""
_GROW = 1.0 + 1e-13  # more than a hundred roundings of sums of products >= 0
_TINY = 1e-300


@dataclass(frozen=True, eq=False)
class Forms:
    """Kernels of a vector function of one column of unknowns; made by :meth:`of`.

    Attributes:
        value: kernel of f, (n_in) to (n_out).
        slope: kernel of the Jacobian, column by column; None where none is.
        smooth: elements of f that the mean-value form is valid for, (n_out,).
    """

    value: IntervalKernel
    slope: IntervalKernel | None
    smooth: np.ndarray[tuple[int, ...], np.dtype[np.bool_]]

    @staticmethod
    def of(x: ca.SX, parts: Sequence[ca.SX]) -> Forms:
        """Kernels of all parts below one another.

        Args:
            x: unknowns, (n, 1).
            parts: expressions of any shape.

        Raises:
            UnsupportedOperationError: intervals cannot do an operation of f.
        """
        columns = [ca.vec(ca.densify(part)) for part in parts]
        y = ca.vertcat(*columns)
        value = IntervalKernel.of(ca.Function("value", [x], [y]))
        smooth = np.concatenate([_continuous(x, c) for c in columns])
        slope = None
        if smooth.any():
            jacobian = ca.densify(_forward(y, x))
            try:
                slope = IntervalKernel.of(ca.Function("slope", [x], [jacobian]))
            except UnsupportedOperationError:
                slope = None
        return Forms(value, slope, smooth)

    def mean_value(
        self, lower: Array, upper: Array, natural: Enclosure
    ) -> tuple[Enclosure, Array]:
        """The intersection of both forms, and how each unknown spreads f.

        Args:
            lower: lower ends, (n_in, B).
            upper: upper ends, (n_in, B).
            natural: natural enclosure over the same boxes.

        Returns:
            The enclosure, and |df_i/dx_j| times the half-width of x_j,
            (n_out, n_in, B); infinite where it is not known.
        """
        assert self.slope is not None
        n_in, n_out = self.value.n_in, self.value.n_out
        centre = middle(lower, upper)
        half = half_widths(lower, upper, centre)
        at = self.value(centre, centre)
        slope = self.slope(lower, upper)
        steep = np.maximum(np.abs(slope.lower), np.abs(slope.upper))
        spread = steep.reshape(n_in, n_out, -1).swapaxes(0, 1) * half
        known = at.bounded & slope.bounded
        spread[:, :, ~known] = np.inf
        total = np.sum(spread, axis=1) * _GROW + _TINY
        low = np.nextafter(at.lower - total, -np.inf)
        high = np.nextafter(at.upper + total, np.inf)
        use = (known & natural.bounded) & self.smooth[:, None]
        with np.errstate(invalid="ignore"):
            low = np.where(use, np.maximum(low, natural.lower), natural.lower)
            high = np.where(use, np.minimum(high, natural.upper), natural.upper)
        return Enclosure(low, high, natural.bounded), spread


def _forward(y: ca.SX, x: ca.SX) -> ca.SX:
    """The Jacobian by forward differentiation, which encloses best."""
    n = x.numel()
    return ca.horzcat(*[ca.jtimes(y, x, ca.SX(ca.DM.eye(n)[:, k])) for k in range(n)])


def middle(lower: Array, upper: Array) -> Array:
    """Where boxes are cut in two; between the ends, and exact to replay."""
    return lower + 0.5 * (upper - lower)


def half_widths(lower: Array, upper: Array, centre: Array) -> Array:
    """No less than the distance of any point of a box from its centre."""
    half = np.maximum(centre - lower, upper - centre)
    return np.nextafter(half, np.inf)


def _continuous(x: ca.SX, column: ca.SX) -> np.ndarray:  # type: ignore[type-arg]
    tape = Tape.of(ca.Function("part", [x], [column]))
    return np.full(column.numel(), tape.operations <= CONTINUOUS)
