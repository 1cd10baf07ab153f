"""How far a sphere can stray from its tangent while joints move a little.

For joint moves ``|delta_k| <= h_k`` a centre goes to ``p + J delta + rest``,

    |rest| <= B(h) / 2,
    B = sum_{k rev} h_k R_k (h_k + 2 sum_{j<k rev} h_j)
        + sum_{k pris} 2 h_k sum_{j<k rev} h_j,

over the joints that move the centre, j < k being nearer to the base.  R_k is
no less than the distance of the centre from joint k's axis: the chain length
between them, each prismatic joint at its largest extension.  All of it are sums
of products of numbers >= 0: ``GROW`` covers their rounding, in any order.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.check.arithmetic.doubles import GROW
from rrnn_opt.check.plans.reading import Array
from rrnn_opt.check.plans.robot.model import Model

PLACED = 5e-9
"""A slide's direction may be off by this before a document is refused."""


def reach_table(model: Model, low: Array, high: Array) -> Array:
    """R: largest distance of each joint's origin to each sphere's centre.

    Args:
        model: the robot.
        low: least joint values that occur, (nj,), m (only prismatic ones count).
        high: greatest, (nj,), m.

    Returns:
        (nj, ns), m; zero where the joint does not move the sphere.
    """
    slide = model.slides * model.prismatic[:, None]
    links = np.maximum(
        _lengths(model.translation + slide * low[:, None]),
        _lengths(model.translation + slide * high[:, None]),
    )
    most = np.maximum(np.abs(low), np.abs(high))
    links += PLACED * most * model.prismatic
    chains = np.zeros((model.nj + 1, model.nj))  # from joint k to joint j: [j, k]
    for j, parent in enumerate(model.parents):
        if parent >= 0:
            chains[j] = (chains[parent] + links[j]) * model.moved_by[parent]
    table = chains[model.carrier] + _lengths(model.centres)[:, None]
    return np.ascontiguousarray((table * model.sphere_moved_by).T * GROW)


def _lengths(rows: Array) -> Array:
    lengths: Array = np.sqrt(np.sum(rows * rows, axis=1))
    return lengths


def motion_bound(
    h: Array,
    reach: Array,
    moved: NDArray[np.bool_],
    prismatic: NDArray[np.bool_],
) -> Array:
    """B of the module's docstring, column by column.

    Args:
        h: bounds of the joint moves, (nj, M), rad or m.
        reach: R, (nj, M), m.
        moved: which joints count, (nj, M) or (nj, 1).
        prismatic: (nj,).

    Returns:
        (M,), m.
    """
    step = h * moved
    slides = prismatic[:, None]
    turned = step * ~slides
    before = np.zeros_like(step)
    np.cumsum(turned[:-1], axis=0, out=before[1:])
    before += before
    before += turned
    before *= step
    before *= np.where(slides, 1.0, reach)
    total: Array = before.sum(axis=0) * GROW
    return total


def travel_levers(
    reach: Array, moved: NDArray[np.bool_], prismatic: NDArray[np.bool_]
) -> Array:
    """Levers L with |p(q + delta) - p(q)| <= L.h: R for a turn, 1 for a slide.

    Args:
        reach: R, (nj, M), m.
        moved: which joints count, (nj, M).
        prismatic: (nj,).

    Returns:
        (nj, M), m.
    """
    levers: Array = np.where(prismatic[:, None], 1.0, reach) * moved * GROW
    return levers
