"""How moving spheres move: Jacobian rows, first order, bounds of the rest."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.check.plans.collision.boxes import Index, Poses
from rrnn_opt.check.plans.collision.rounding import Rounding, slack
from rrnn_opt.check.plans.reading import Array
from rrnn_opt.check.plans.robot.model import Model
from rrnn_opt.check.plans.robot.motion_bound import motion_bound, travel_levers


def row_jacobian(poses: Poses, box: Index, points: Array, n: Array) -> Array:
    """Rows n'J of points at the joints (unmasked), (M, nj)."""
    wrench = np.empty((len(box), 6, 1))
    wrench[:, 0, 0] = points[:, 1] * n[:, 2] - points[:, 2] * n[:, 1]
    wrench[:, 1, 0] = points[:, 2] * n[:, 0] - points[:, 0] * n[:, 2]
    wrench[:, 2, 0] = points[:, 0] * n[:, 1] - points[:, 1] * n[:, 0]
    wrench[:, 3:, 0] = n
    row: Array = np.matmul(poses.screws[box], wrench)[:, :, 0]
    return row


def first_order(poses: Poses, box: Index, row: Array) -> Array:
    """Largest |n'J delta| inside the box, from the cubic's own terms."""
    along: Array = np.matmul(row[:, None], poses.terms[box])[:, 0]
    most: Array = np.abs(along).sum(axis=1)
    return most


@dataclass(frozen=True, eq=False)
class Movers:
    """Spheres, and the joints that count for them.

    Attributes:
        spheres: their indices, (m,).
        moved: joints that count, (m, nj).
        reach: (m, nj), m.
        levers: see :func:`travel_levers`, (m, nj), m.
        room: rounding of all bounds but for the solid, m.
    """

    spheres: Index
    moved: NDArray[np.bool_]
    reach: Array
    levers: Array
    room: float

    @staticmethod
    def of(
        model: Model,
        spheres: Index,
        moved: NDArray[np.bool_],
        reach: Array,
        errors: Rounding,
    ) -> Movers:
        """These spheres, moved by these joints."""
        reach = reach[spheres]
        levers = travel_levers(reach, moved, model.prismatic)
        return Movers(spheres, moved, reach, levers, slack(errors, spheres, levers))

    def bend(
        self, poses: Poses, box: Index, row: Index, points: Array, n: Array
    ) -> tuple[Array, Array]:
        """Rows n'J at the joints that count, (M, nj), and B(h), (M,), m."""
        slides = poses.model.prismatic
        jacobian = row_jacobian(poses, box, points, n) * self.moved[row]
        sway = poses.sway[box]
        rest = motion_bound(sway, self.reach[row], self.moved[row], slides)
        return jacobian, rest


def way(poses: Poses, levers: Array, box: Index, pair: Index) -> Array:
    """Levers times moves, row by row, (M,), m."""
    if len(box) > len(poses.sway) * len(levers) / 8:
        return np.asarray(poses.sway @ levers.T)[box, pair]
    far: Array = np.einsum("ij,ij->i", poses.sway[box], levers[pair])
    return far
