"""How far a sphere can stray from its tangent while joints move a little.

For joint moves ``|delta_k| <= h_k`` a centre goes to ``p + J delta + rest``,

    |rest| <= B(h) / 2,
    B = sum_{k rev} h_k R_k (h_k + 2 sum_{j<k rev} h_j)
        + sum_{k pris} 2 h_k sum_{j<k rev} h_j,

over the joints that move the centre, j < k being nearer to the base.  R_k is
no less than the distance of the centre from joint k's axis: the chain length
between them, each prismatic joint at its largest extension.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.check.model import Model
from rrnn_opt.check.reading import Array


def reach_table(model: Model, low: Array, high: Array) -> Array:
    """R: largest distance of each joint's origin to each sphere's centre.

    Args:
        model: the robot.
        low: least joint values that occur, (nj,), m (only prismatic ones count).
        high: greatest, (nj,), m.

    Returns:
        (ns, nj), m; zero where the joint does not move the sphere.
    """
    slide = np.einsum("kij,kj->ki", model.rotation, model.axes)
    slide = slide * model.prismatic[:, None]
    links = np.maximum(
        np.linalg.norm(model.translation + slide * low[:, None], axis=1),
        np.linalg.norm(model.translation + slide * high[:, None], axis=1),
    )
    table = np.zeros((len(model.radii), model.nj))
    for i, joint in enumerate(model.carrier):
        length = float(np.linalg.norm(model.centres[i]))
        k = int(joint)
        while k >= 0:
            table[i, k] = length
            length += float(links[k])
            k = int(model.parents[k])
    return table


def motion_bound(
    h: Array,
    reach: Array,
    moved: NDArray[np.bool_],
    prismatic: NDArray[np.bool_],
) -> Array:
    """B of the module's docstring, row by row.

    Args:
        h: bounds of the joint moves, (M, nj), rad or m.
        reach: R, (M, nj), m.
        moved: which joints count, (M, nj) or (nj,).
        prismatic: (nj,).

    Returns:
        (M,), m.
    """
    step = h * moved
    turned = step * ~prismatic
    before = np.cumsum(turned, axis=1) - turned
    revolute = step * reach * (step + 2 * before)
    sliding = 2 * step * before
    total: Array = np.sum(np.where(prismatic, sliding, revolute), axis=1)
    return total


def travel_levers(
    reach: Array, moved: NDArray[np.bool_], prismatic: NDArray[np.bool_]
) -> Array:
    """Levers L with |p(q + delta) - p(q)| <= L.h: R for a turn, 1 for a slide."""
    levers: Array = np.where(prismatic, 1.0, reach) * moved
    return levers
