"""Boxes of time, and what a robot does inside them.

A box is [m - tau, m + tau] inside one cubic piece, in the piece's own time from
0 to 1.  m and tau are dyadic: boxes tile a piece exactly.  With the derivatives
v, a, j of a joint at m, its move is ``delta(s) = v s + a s^2 / 2 + j s^3 / 6``
for ``|s| <= tau``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.check.plans import hermite
from rrnn_opt.check.plans.collision.rounding import Rounding
from rrnn_opt.check.plans.hermite import Pieces
from rrnn_opt.check.plans.reading import Array
from rrnn_opt.check.plans.robot import kinematics
from rrnn_opt.check.plans.robot.model import Model

Index = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Boxes:
    """Time boxes of one cubic motion.

    Attributes:
        piece: index of the cubic piece, (B,).
        middle: local time of the middle, (B,), 1 being the piece's end.
        half: half length tau, (B,).
    """

    piece: Index
    middle: Array
    half: Array

    @staticmethod
    def whole(first: int, last: int) -> Boxes:
        """One box for each piece of [first, last)."""
        half = np.full(last - first, 0.5)
        return Boxes(np.arange(first, last), half, half)

    def halves(self, chosen: Index) -> Boxes:
        """Both halves of the chosen boxes, side by side; exact to depth 50."""
        half = np.repeat(self.half[chosen] / 2, 2)
        side = np.tile([-1.0, 1.0], len(chosen))
        middle = np.repeat(self.middle[chosen], 2) + side * half
        return Boxes(np.repeat(self.piece[chosen], 2), middle, half)


@dataclass(frozen=True, eq=False)
class Poses:
    """The robot at the middle of B boxes, which come last in every array.

    Attributes:
        model: the robot.
        joints: joint values, (nj, B).
        origins: joint origins, (nj, 3, B), m.
        axes: joint axes, (nj, 3, B).
        screws: columns (a, -a x o) of turns and (0, a) of slides, (6, nj, B): with
            (p x n, n) they give n'J of a point p.
        centres: sphere centres, (3, ns, B), m.
        terms: v tau, a tau^2 / 2, j tau^3 / 6, (3, nj, B).
        sway: bound h of the joint moves, rounding included, (nj, B).
    """

    model: Model
    joints: Array
    origins: Array
    axes: Array
    screws: Array
    centres: Array
    terms: Array
    sway: Array

    def points(self, box: Index, sphere: Index) -> Array:
        """Centres of spheres in boxes, (3, M), m."""
        columns = self.centres.reshape(3, -1)
        found: Array = columns.take(sphere * self.centres.shape[2] + box, axis=1)
        return found


def joint_pieces(model: Model, pieces: Pieces) -> Pieces:
    """Cubics of the coordinates turned into cubics of the joint values, (nj, n - 1)."""
    scale = model.multiplier[:, None]
    scaled = [c.T[model.source] * scale for c in pieces[1:]]
    scaled[0] += model.offset[:, None]
    return Pieces(pieces.h, *scaled)


def poses(model: Model, joint: Pieces, boxes: Boxes, errors: Rounding) -> Poses:
    """Forward kinematics at the middle of every box, and the joints' moves."""
    local = Pieces(joint.h, *(c.take(boxes.piece, axis=1) for c in joint[1:]))
    s, tau = boxes.middle, boxes.half
    values = hermite.position(local, s)
    rate = hermite.velocity(local, s)
    bend = local.c2 + 3 * s * local.c3
    terms = np.stack([rate * tau, bend * tau**2, local.c3 * tau**3])
    frames = kinematics.forward(model, values)
    return Poses(
        model=model,
        joints=values,
        origins=frames.origins,
        axes=frames.axes,
        screws=_screws(model, frames),
        centres=kinematics.sphere_centres(model, frames),
        terms=terms,
        sway=np.abs(terms).sum(axis=0) + errors.values[:, None],
    )


def _screws(model: Model, frames: kinematics.Frames) -> Array:
    a, o = frames.axes.swapaxes(0, 1), frames.origins.swapaxes(0, 1)
    rows = np.empty((6, *a.shape[1:]))
    rows[:3] = a
    rows[3] = a[2] * o[1] - a[1] * o[2]
    rows[4] = a[0] * o[2] - a[2] * o[0]
    rows[5] = a[1] * o[0] - a[0] * o[1]
    rows[:3, model.prismatic] = 0.0
    rows[3:, model.prismatic] = a[:, model.prismatic]
    return rows
