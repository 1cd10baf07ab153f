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
    """The robot at the middle of B boxes.

    Attributes:
        model: the robot.
        joints: joint values, (B, nj).
        origins: joint origins, (B, nj, 3), m.
        axes: joint axes, (B, nj, 3).
        screws: rows (a, -a x o) of turns and (0, a) of slides, (B, nj, 6): with
            (p x n, n) they give n'J of a point p.
        centres: sphere centres, (B, ns, 3), m.
        terms: v tau, a tau^2 / 2, j tau^3 / 6, (B, nj, 3).
        sway: bound h of the joint moves, rounding included, (B, nj).
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
        """Centres of spheres in boxes, (M, 3), m."""
        rows = self.centres.reshape(-1, 3)
        points: Array = rows.take(box * self.centres.shape[1] + sphere, axis=0)
        return points


def joint_pieces(model: Model, pieces: Pieces) -> Pieces:
    """Cubics of the coordinates turned into cubics of the joint values."""
    scaled = [c[:, model.source] * model.multiplier for c in pieces[1:]]
    scaled[0] = scaled[0] + model.offset
    return Pieces(pieces.h, *scaled)


def poses(model: Model, joint: Pieces, boxes: Boxes, errors: Rounding) -> Poses:
    """Forward kinematics at the middle of every box, and the joints' moves."""
    local = Pieces(joint.h, *(c[boxes.piece] for c in joint[1:]))
    s, tau = boxes.middle[:, None], boxes.half[:, None]
    values = hermite.position(local, s)
    rate = hermite.velocity(local, s)
    bend = local.c2 + 3 * s * local.c3
    terms = np.stack([rate * tau, bend * tau**2, local.c3 * tau**3], axis=2)
    frames = kinematics.forward(model, values)
    return Poses(
        model=model,
        joints=values,
        origins=frames.origins,
        axes=frames.axes,
        screws=_screws(model, frames),
        centres=kinematics.sphere_centres(model, frames),
        terms=terms,
        sway=np.abs(terms).sum(axis=2) + errors.values,
    )


def _screws(model: Model, frames: kinematics.Frames) -> Array:
    a, o = np.moveaxis(frames.axes, 2, 0), np.moveaxis(frames.origins, 2, 0)
    rows = np.empty((*frames.axes.shape[:2], 6))
    rows[..., :3] = frames.axes
    rows[..., 3] = a[2] * o[1] - a[1] * o[2]
    rows[..., 4] = a[0] * o[2] - a[2] * o[0]
    rows[..., 5] = a[1] * o[0] - a[0] * o[1]
    rows[:, model.prismatic, :3] = 0.0
    rows[:, model.prismatic, 3:] = frames.axes[:, model.prismatic]
    return rows
