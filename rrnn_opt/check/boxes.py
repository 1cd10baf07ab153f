"""Boxes of time, and what a robot does inside them.

A box is [m - tau, m + tau] inside one cubic piece.  With the derivatives
v, a, j of a joint at m, its move is exactly
``delta(s) = v s + a s^2 / 2 + j s^3 / 6`` for ``|s| <= tau``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.check import hermite, kinematics
from rrnn_opt.check.hermite import Pieces
from rrnn_opt.check.model import Model
from rrnn_opt.check.reading import Array

Index = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Boxes:
    """Time boxes of one cubic motion.

    Attributes:
        piece: index of the cubic piece, (B,).
        middle: local time of the middle, (B,), s.
        half: half length tau, (B,), s.
    """

    piece: Index
    middle: Array
    half: Array

    @staticmethod
    def whole(pieces: Pieces, first: int, last: int) -> Boxes:
        """One box for each piece of [first, last)."""
        half = pieces.h[first:last] / 2
        return Boxes(np.arange(first, last), half, half)

    def halves(self, chosen: Index) -> Boxes:
        """Both halves of the chosen boxes, side by side."""
        half = np.repeat(self.half[chosen] / 2, 2)
        side = np.tile([-1.0, 1.0], len(chosen))
        middle = np.repeat(self.middle[chosen], 2) + side * half
        return Boxes(np.repeat(self.piece[chosen], 2), middle, half)


@dataclass(frozen=True, eq=False)
class Poses:
    """The robot at the middle of B boxes.

    Attributes:
        joints: joint values, (B, nj).
        origins: joint origins, (B, nj, 3), m.
        axes: joint axes, (B, nj, 3).
        centres: sphere centres, (B, ns, 3), m.
        terms: v tau, a tau^2 / 2, j tau^3 / 6, (3, B, nj).
        sway: bound h of the joint moves, (B, nj).
    """

    joints: Array
    origins: Array
    axes: Array
    centres: Array
    terms: Array
    sway: Array


def joint_pieces(model: Model, pieces: Pieces) -> Pieces:
    """Cubics of the coordinates turned into cubics of the joint values."""
    scaled = [c[:, model.source] * model.multiplier for c in pieces[1:]]
    scaled[0] = scaled[0] + model.offset
    return Pieces(pieces.h, *scaled)


def poses(model: Model, joint: Pieces, boxes: Boxes) -> Poses:
    """Forward kinematics at the middle of every box, and the joints' moves."""
    local = Pieces(joint.h, *(c[boxes.piece] for c in joint[1:]))
    s, tau = boxes.middle[:, None], boxes.half[:, None]
    values = hermite.position(local, s)
    rate = hermite.velocity(local, s)
    bend = local.c2 + 3 * s * local.c3
    terms = np.stack([rate * tau, bend * tau**2, local.c3 * tau**3])
    frames = kinematics.forward(model, values)
    return Poses(
        joints=values,
        origins=frames.origins,
        axes=frames.axes,
        centres=kinematics.sphere_centres(model, frames),
        terms=terms,
        sway=np.abs(terms).sum(axis=0),
    )
