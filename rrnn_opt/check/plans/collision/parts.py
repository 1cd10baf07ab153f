"""Which spheres of a robot must keep apart, and what moves them: known once read.

Nothing here depends on a motion or a scene, so many motions of one robot can be
judged by the same parts.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.check.plans.collision.bodies import Bodies, Index, with_balls
from rrnn_opt.check.plans.robot.model import Model


class Grouping(NamedTuple):
    """Rows of a finer level, group by group.

    Attributes:
        order: the finer rows' numbers.
        sizes: how many each group has.
    """

    order: Index
    sizes: Index


@dataclass(frozen=True, eq=False)
class Selection:
    """Spheres, the joints that count for them, and whom they stand for.

    Attributes:
        spheres: their indices, one column for obstacles, two for self pairs, (n, c).
        moved: joints that count, for each column, c times (n, nj).
        finer: the rows of the next finer selection; None in the finest.
    """

    spheres: Index
    moved: tuple[NDArray[np.bool_], ...]
    finer: Grouping | None = None

    @property
    def sides(self) -> list[tuple[Index, NDArray[np.bool_]]]:
        """Column by column: spheres, (n,), and the joints that count, (n, nj)."""
        return list(zip(self.spheres.T, self.moved, strict=True))


@dataclass(frozen=True, eq=False)
class Parts:
    """A robot's spheres and balls, and what of them must keep apart.

    Attributes:
        bodies: the robot with its balls.
        singles: what must keep off obstacles: spheres, then bodies.
        pairs: what must keep off one another: spheres, then cells, then bodies.
    """

    bodies: Bodies
    singles: tuple[Selection, ...]
    pairs: tuple[Selection, ...]

    @staticmethod
    def of(model: Model) -> Parts:
        """The parts of this robot."""
        bodies = with_balls(model)
        return Parts(bodies, _singles(bodies), _pairs(bodies))


def _singles(bodies: Bodies) -> tuple[Selection, ...]:
    model = bodies.model
    spheres = np.flatnonzero(model.carrier[: bodies.ns] >= 0)
    keys, grouping = _grouped(bodies.body[spheres][:, None])
    found = ((spheres[:, None], None), (keys, grouping))
    return tuple(
        Selection(rows, (model.sphere_moved_by[rows[:, 0]],), finer)
        for rows, finer in found
    )


def _pairs(bodies: Bodies) -> tuple[Selection, ...]:
    model = bodies.model
    # two bodies that cannot move are nobody's concern
    pairs = model.pairs[np.any(model.carrier[model.pairs] >= 0, axis=1)]
    found = [_between(model, pairs, None)]
    for up in (bodies.cell, bodies.body):
        pairs, grouping = _grouped(up[pairs])
        found.append(_between(model, pairs, grouping))
    return tuple(found)


def _between(model: Model, pairs: Index, finer: Grouping | None) -> Selection:
    """Pairs, each side moved by the joints that do not move the other."""
    i, j = (model.sphere_moved_by[side] for side in pairs.T)
    return Selection(pairs, (i & ~j, j & ~i), finer)


def _grouped(rows: Index) -> tuple[Index, Grouping]:
    """Different rows, and the rows' numbers group by group."""
    keys, group, sizes = np.unique(
        rows, axis=0, return_inverse=True, return_counts=True
    )
    return keys, Grouping(np.argsort(group.ravel(), kind="stable"), sizes)
