"""The parts of a quadratic programme and of an answer to it, as dense arrays."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rrnn_opt.arguments import require_parts

Array = NDArray[np.float64]

OSQP_JUNK = 2143289344.0
"""The bits of a float NaN read as an integer: OSQP's answer without a solution."""


@dataclass(frozen=True, eq=False)
class Duals:
    """Multipliers in the signs of ``qpsolvers``.

    Attributes:
        y: of the equalities, (meq,).
        z: of the inequalities, (mineq,), not negative.
        z_box: of the bounds, (n,): positive at an upper, negative at a lower one.
    """

    y: Array
    z: Array
    z_box: Array


@dataclass(frozen=True, eq=False)
class Dense:
    """A ``qpsolvers.Problem`` with every part present as a dense array.

    Attributes:
        P: (n, n) Hessian.
        q: (n,) linear cost.
        G: (mineq, n) inequality rows.
        h: (mineq,).
        A: (meq, n) equality rows.
        b: (meq,).
        lb: (n,), -inf where free.
        ub: (n,), +inf where free.
    """

    P: Array
    q: Array
    G: Array
    h: Array
    A: Array
    b: Array
    lb: Array
    ub: Array

    @staticmethod
    def of(problem: Any) -> Dense:
        """The dense parts of ``problem`` (a ``qpsolvers.Problem``)."""
        if isinstance(problem, Dense):
            return problem
        require_parts(problem, "problem", ("unpack_as_dense",))
        P, q, G, h, A, b, lb, ub = problem.unpack_as_dense()
        q = np.asarray(q, dtype=np.float64).ravel()
        n = q.size

        def rows(value: Any) -> Array:
            return np.zeros((0, n)) if value is None else np.atleast_2d(value)

        def column(value: Any, size: int, absent: float) -> Array:
            if value is None:
                return np.full(size, absent)
            return np.asarray(value, dtype=np.float64).ravel()

        G, A = rows(G), rows(A)
        return Dense(
            P=np.asarray(P, dtype=np.float64),
            q=q,
            G=G,
            h=column(h, len(G), 0.0),
            A=A,
            b=column(b, len(A), 0.0),
            lb=column(lb, n, -np.inf),
            ub=column(ub, n, np.inf),
        )


def is_usable(x: ArrayLike | None, size: int) -> bool:
    """Whether ``x`` is a finite vector of that size and not OSQP's junk."""
    if x is None:
        return False
    values = np.asarray(x, dtype=np.float64)
    if values.shape != (size,):
        return False
    return bool(np.isfinite(values).all() and not (values == OSQP_JUNK).any())


def handed(x: ArrayLike | None) -> str:
    """What sort of point: "none", "NaN", OSQP's "junk", "zeros", or "numbers"."""
    if x is None:
        return "none"
    values = np.asarray(x, dtype=np.float64)
    if (values == OSQP_JUNK).any():
        return "junk"
    if not np.isfinite(values).all():
        return "NaN"
    return "numbers" if values.any() else "zeros"
