"""A timed motion in the checker's own terms."""

from __future__ import annotations

from dataclasses import dataclass

from rrnn_opt.check.plans import hermite
from rrnn_opt.check.plans.hermite import Pieces
from rrnn_opt.check.plans.reading import Array


@dataclass(frozen=True, eq=False)
class Motion:
    """A timed motion in the checker's own terms.

    Attributes:
        t: (n,), s.
        q: (n, nv).
        qd: (n, nv).
        pieces: cubics of the coordinates over time.
        unit: the same over each piece's time from 0 to 1.
    """

    t: Array
    q: Array
    qd: Array
    pieces: Pieces
    unit: Pieces

    @staticmethod
    def of(t: Array, q: Array, qd: Array) -> Motion:
        """The motion of these rows."""
        unit = hermite.unit_pieces(t, q, qd)
        return Motion(t, q, qd, hermite.pieces(t, q, qd), unit)
