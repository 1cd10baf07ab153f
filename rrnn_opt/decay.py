"""Claims that linear systems decay at a rate: frozen networks, polytopes of Jacobians.

Like :class:`~rrnn_opt.claim.Claim` a statement as data; it settles nothing.
"""

from __future__ import annotations

import hashlib
import itertools
import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from rrnn_opt.claim import JACOBIANS, ORDERS, Hypothesis
from rrnn_opt.errors import RrnnError, ShapeError

Matrix = tuple[tuple[Fraction, ...], ...]
Rows = Sequence[Sequence[Fraction | int | float]]


@dataclass(frozen=True, eq=False)
class DecayClaim:
    """Solutions of ``x' = A(t) x`` decay as ``exp(-rate t)``, whatever A(t) does.

    A(t) moves in the convex hull of the vertices.  Discrete: solutions of
    ``x_{k+1} = A_k x_k`` decay as ``rate^k``.  Up to a constant factor, in any
    norm.

    Attributes:
        id: e.g. "C11".
        source: where it is stated.
        statement: in words.
        vertices: square matrices of one size; floats are taken for the fractions
            that they are.
        rate: 1/s (or 1/step of the time unit of A), at least 0; discrete: the
            contraction factor of a step, in [0, 1].
        discrete: whether time is discrete.
        hypotheses: assumptions in words, e.g. that no bound is active.
        order: "first-order", "second-order" or "discrete" dynamics, or None.
        jacobian: "frozen" or "moving", or None.

    Raises:
        RrnnError: no vertex, a bad rate, a hypothesis with a relation, or an
            unknown order or jacobian.
        ShapeError: a vertex is not square, or of another size.
    """

    id: str
    source: str
    statement: str
    vertices: tuple[Matrix, ...]
    rate: Fraction
    discrete: bool = False
    hypotheses: tuple[Hypothesis, ...] = ()
    order: str | None = None
    jacobian: str | None = None

    def __post_init__(self) -> None:
        exact = tuple(exact_matrix(rows) for rows in self.vertices)
        object.__setattr__(self, "vertices", exact)
        object.__setattr__(self, "rate", exact_matrix([[self.rate]])[0][0])
        if not self.vertices or not self.vertices[0]:
            raise RrnnError(f"{self.id}: give at least one matrix")
        size = len(self.vertices[0])
        for number, rows in enumerate(self.vertices):
            for row in (rows, *rows):
                if len(row) != size:
                    where = f"{self.id}: vertex {number}"
                    raise ShapeError(where, (size, size), (len(rows), len(row)))
        if self.rate < 0 or (self.discrete and self.rate > 1):
            raise RrnnError(
                f"{self.id}: rate {self.rate}: a rate is at least 0, a contraction"
                " factor lies in [0, 1]"
            )
        if any(h.relation is not None for h in self.hypotheses):
            raise RrnnError(f"{self.id}: hypotheses of a decay are in words only")
        if self.order not in (*ORDERS, None) or self.jacobian not in (*JACOBIANS, None):
            raise RrnnError(f"{self.id}: order or jacobian is unknown")

    @property
    def fingerprint(self) -> str:
        """SHA-256 of what is claimed; id, words and source are not part of it."""
        content = [
            "decay",
            [[[str(x) for x in row] for row in rows] for rows in self.vertices],
            str(self.rate),
            self.discrete,
            self.order,
            self.jacobian,
            [[h.statement, h.added] for h in self.hypotheses],
        ]
        return hashlib.sha256(json.dumps(content).encode()).hexdigest()


def exact_matrix(rows: Rows) -> Matrix:
    """A matrix of exact numbers; a float is the rational number that it is.

    Raises:
        RrnnError: it is no rows of finite numbers.
    """
    try:
        return tuple(tuple(Fraction(x) for x in row) for row in rows)
    except (TypeError, ValueError, OverflowError) as error:
        raise RrnnError("matrix: give rows of finite numbers") from error


def corner_matrices(
    matrix: Callable[..., Rows],
    ranges: Sequence[tuple[Fraction | int, Fraction | int]],
) -> tuple[Matrix, ...]:
    """The matrices at the corners of a box of parameters.

    Their convex hull holds the matrix at every point of the box if every entry
    is affine in each parameter while the others rest; that is the caller's
    promise, and a hypothesis of what is claimed of the vertices.

    Args:
        matrix: rows of numbers for given parameters, in exact arithmetic.
        ranges: (lower, upper) of each parameter.
    """
    corners = itertools.product(*(dict.fromkeys(pair) for pair in ranges))
    return tuple(exact_matrix(matrix(*map(Fraction, corner))) for corner in corners)
