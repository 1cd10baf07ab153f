"""How moving spheres move: Jacobian rows, first order, bounds of the rest."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.check.plans.collision.boxes import Index, Poses
from rrnn_opt.check.plans.collision.rounding import Rounding, slack
from rrnn_opt.check.plans.reading import Array
from rrnn_opt.check.plans.robot.model import Model
from rrnn_opt.check.plans.robot.motion_bound import motion_bound, travel_levers


def row_jacobian(poses: Poses, box: Index, points: Array, n: Array) -> Array:
    """Rows n'J of points (3, M) at the joints (unmasked), (nj, M)."""
    x, y, z = points
    wrench = np.empty((6, 1, len(box)))
    wrench[0, 0] = y * n[2] - z * n[1]
    wrench[1, 0] = z * n[0] - x * n[2]
    wrench[2, 0] = x * n[1] - y * n[0]
    wrench[3:, 0] = n
    row: Array = (poses.screws.take(box, axis=2) * wrench).sum(axis=0)
    return row


def first_order(poses: Poses, box: Index, row: Array) -> Array:
    """Largest |n'J delta| inside the box, from the cubic's own terms, (M,)."""
    along: Array = (poses.terms.take(box, axis=2) * row).sum(axis=1)
    most: Array = np.abs(along).sum(axis=0)
    return most


@dataclass(frozen=True, eq=False)
class Movers:
    """Spheres, and the joints that count for them.

    Attributes:
        spheres: their indices, (m,).
        moved: joints that count, (nj, m).
        reach: (nj, m), m.
        levers: see :func:`travel_levers`, (nj, m), m.
        room: rounding of all bounds but for the solid, m.
    """

    spheres: Index
    moved: NDArray[np.bool_]
    reach: Array
    levers: Array
    room: float

    def bend(
        self, poses: Poses, box: Index, row: Index, points: Array, n: Array
    ) -> tuple[Array, Array]:
        """Rows n'J at the joints that count, (nj, M), and B(h), (M,), m."""
        moved = self.moved.take(row, axis=1)
        jacobian = row_jacobian(poses, box, points, n) * moved
        sway, reach = poses.sway.take(box, axis=1), self.reach.take(row, axis=1)
        return jacobian, motion_bound(sway, reach, moved, poses.model.prismatic)


def make_movers(
    model: Model,
    groups: Sequence[tuple[Index, NDArray[np.bool_]]],
    reach: Array,
    errors: Rounding,
) -> list[Movers]:
    """Movers of several groups of spheres, all at once.

    Args:
        model: the robot.
        groups: spheres, (m,), and the joints that count for them, (m, nj).
        reach: of all spheres, (nj, ns), m.
        errors: rounding of the robot's own numbers.
    """
    spheres = np.concatenate([group[0] for group in groups])
    moved = np.ascontiguousarray(np.concatenate([group[1] for group in groups]).T)
    mine = reach.take(spheres, axis=1)
    levers = travel_levers(mine, moved, model.prismatic)
    rooms = slack(errors, spheres, levers)
    ends = np.cumsum([len(group[0]) for group in groups])
    made = []
    for (own, _), end in zip(groups, ends.tolist(), strict=True):
        at = slice(end - len(own), end)
        room = float(rooms[at].max(initial=0.0))
        made.append(Movers(own, moved[:, at], mine[:, at], levers[:, at], room))
    return made


def way(poses: Poses, levers: Array, box: Index, pair: Index) -> Array:
    """Levers times moves, row by row, (M,), m."""
    far: Array = (poses.sway.take(box, axis=1) * levers.take(pair, axis=1)).sum(axis=0)
    return far
