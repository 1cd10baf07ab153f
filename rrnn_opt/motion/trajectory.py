"""Timed motion: rows of (t, q, qd), cubic Hermite polynomials between them."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rrnn_opt.arguments import checked
from rrnn_opt.check.plans import hermite
from rrnn_opt.errors import ArgumentError, NotFiniteError, RetimeError, ShapeError

Array = NDArray[np.float64]


@checked()
@dataclass(frozen=True, eq=False)
class Trajectory:
    """What is delivered: between rows the cubic Hermite of ``q`` and ``qd``.

    Attributes:
        t: times, strictly increasing, (n,), n >= 2, s.
        q: positions, (n, nv), rad or m.
        qd: velocities, (n, nv), rad/s or m/s.
        qdd: second derivative at the start of each piece (last row: at the end
            of the last), (n, nv), rad/s2 or m/s2.
    """

    t: Array
    q: Array
    qd: Array
    qdd: Array

    @staticmethod
    @checked()
    def from_rows(t: ArrayLike, q: ArrayLike, qd: ArrayLike) -> Trajectory:
        """A trajectory from its rows; ``qdd`` follows from them.

        Args:
            t: times, (n,), s, increasing.
            q: joint positions, (n, nv), rad or m.
            qd: joint velocities, (n, nv), rad/s or m/s.

        Raises:
            ShapeError: shapes do not fit.
            NotFiniteError: a number is NaN or infinite.
            RetimeError: times do not increase strictly.
        """
        times, rows, rates = (np.array(x, dtype=np.float64) for x in (t, q, qd))
        if times.ndim != 1 or len(times) < 2:
            raise ShapeError("t", (2,), times.shape)
        if rows.ndim != 2 or len(rows) != len(times):
            raise ShapeError("q", (len(times), 1), rows.shape)
        if rates.shape != rows.shape:
            raise ShapeError("qd", rows.shape, rates.shape)
        for name, values in (("t", times), ("q", rows), ("qd", rates)):
            if not np.all(np.isfinite(values)):
                raise NotFiniteError(name)
        if np.any(np.diff(times) <= 0):
            raise RetimeError("times must increase strictly", "bad times")
        pieces = hermite.pieces(times, rows, rates)
        qdd = hermite.second_derivatives(pieces)
        for values in (times, rows, rates, qdd):
            values.flags.writeable = False
        made = Trajectory(times, rows, rates, qdd)
        made.__dict__["pieces"] = pieces  # what the property would find again
        return made

    @property
    def duration(self) -> float:
        """Time of the last row, s."""
        return float(self.t[-1])

    @cached_property
    def pieces(self) -> hermite.Pieces:
        """The cubics between the rows."""
        return hermite.pieces(self.t, self.q, self.qd)

    @checked()
    def at(self, t: ArrayLike) -> tuple[Array, Array, Array]:
        """Position, velocity and acceleration at any times.

        Args:
            t: (M,) or a number, s; outside [0, duration] the ends are taken.

        Returns:
            q (rad or m), qd (a second), qdd (a second squared), each (M, nv),
            or (nv,) for a number.
        """
        wanted = np.clip(np.asarray(t, dtype=np.float64), self.t[0], self.t[-1])
        last = len(self.t) - 2
        piece = np.clip(np.searchsorted(self.t, wanted, side="right") - 1, 0, last)
        p = self.pieces
        s = (wanted - self.t[piece])[..., None]
        local = hermite.Pieces(p.h[piece], *(c[piece] for c in p[1:]))
        rates = hermite.velocity(local, s)
        bends = np.asarray(2 * local.c2 + 6 * s * local.c3, dtype=np.float64)
        return hermite.position(local, s), rates, bends

    @checked()
    def stretched(self, factor: float) -> Trajectory:
        """The same path, ``factor`` times slower.

        Args:
            factor: ratio of the new duration to the old, positive.

        Raises:
            RetimeError: the factor is not a positive number.
        """
        if not 0 < factor < np.inf:
            raise RetimeError("the stretch must be positive", "bad factor")
        return Trajectory.from_rows(self.t * factor, self.q, self.qd / factor)

    def to_dict(self) -> dict[str, Any]:
        """The "trajectory" object of a plan."""
        rows = {name: rows.tolist() for name, rows in self.columns().items()}
        return {**rows, "duration": self.duration}

    def columns(self) -> dict[str, Array]:
        """Its arrays t, q, qd and qdd by name: what a checker reads."""
        return {name: getattr(self, name) for name in ("t", "q", "qd", "qdd")}

    @staticmethod
    @checked()
    def from_dict(data: Mapping[str, Any]) -> Trajectory:
        """A trajectory from the "trajectory" object of a plan.

        ``qdd`` is derived again, as it follows from the rest.

        Args:
            data: lists "t" (s), "q" and "qd" by row.

        Raises:
            ArgumentError: one of them is missing.
        """
        missing = [name for name in ("t", "q", "qd") if name not in data]
        if missing:
            raise ArgumentError("Trajectory.from_dict", f"there is no {missing[0]!r}")
        return Trajectory.from_rows(data["t"], data["q"], data["qd"])

    def write_csv(self, path: str | Path) -> None:
        """Write columns t, q1.., qd1.., qdd1.. with a header, full precision."""
        nv = self.q.shape[1]
        head = [f"{name}{k + 1}" for name in ("q", "qd", "qdd") for k in range(nv)]
        table = np.column_stack([self.t, self.q, self.qd, self.qdd])
        with Path(path).open("w", newline="", encoding="utf-8") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow(["t", *head])
            writer.writerows([[repr(x) for x in row] for row in table.tolist()])
