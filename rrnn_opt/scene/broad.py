"""A tree of boxes over the solids of a scene, built from their Morton order.

Solids near one another in space are near in the order, so that eight
neighbours make a leaf, eight leaves a node, and so on up to the root.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.scene.records import Array, Index, Records, records
from rrnn_opt.scene.scene import Scene

WIDTH = 8
"""Children of a node, and solids of a leaf."""
SMALL = 16
"""Scenes with no more bounded solids than this need no tree."""
_BITS = 20


@dataclass(frozen=True, eq=False)
class BroadPhase:
    """Solids in the tree's order, and the tree; the root is node 0.

    Attributes:
        solids: the solids; the first ``flat`` hang on no node.
        flat: their number.
        bounds: of the nodes, least and greatest coordinates, (k, 6), m.
        first: first child of a node, a solid from node ``leaf`` on, (k,).
        size: number of children, (k,).
        leaf: first node that holds solids.
    """

    solids: Records
    flat: int
    bounds: Array
    first: Index
    size: Index
    leaf: int


def broad_phase(scene: Scene) -> BroadPhase:
    """The solids of a scene, and the tree over them.

    Args:
        scene: the obstacles.
    """
    solids = records(scene)
    bounded = len(solids.kind) - solids.unbounded
    if bounded <= SMALL:
        none = np.zeros(0, np.int32)
        return BroadPhase(solids, len(solids.kind), np.zeros((0, 6)), none, none, 0)
    flat = solids.unbounded
    inside = flat + np.argsort(_morton(solids.bounds[flat:]), kind="stable")
    order = np.concatenate([np.arange(flat), inside])
    placed = replace(
        solids,
        kind=solids.kind[order],
        first=solids.first[order],
        bounds=solids.bounds[order],
        owner=solids.owner[order],
    )
    levels = [_level(placed.bounds[flat:], flat)]
    while len(levels[0][0]) > 1:
        levels.insert(0, _level(levels[0][0], 0))
    starts = np.cumsum([0, *(len(level[0]) for level in levels)])
    for k, (_, first, _) in enumerate(levels[:-1]):
        first += np.int32(starts[k + 1])
    bounds, first, size = (np.concatenate([lv[i] for lv in levels]) for i in range(3))
    leaf = int(starts[len(levels) - 1])
    return BroadPhase(placed, flat, bounds, first, size, leaf)


def _level(boxes: Array, offset: int) -> tuple[Array, Index, Index]:
    """Boxes around every eight neighbours, their first ones and their numbers."""
    first = np.arange(0, len(boxes), WIDTH)
    low = np.minimum.reduceat(boxes[:, :3], first)
    high = np.maximum.reduceat(boxes[:, 3:], first)
    size = np.diff(np.append(first, len(boxes)))
    return (
        np.hstack([low, high]),
        (first + offset).astype(np.int32),
        size.astype(np.int32),
    )


def _morton(boxes: Array) -> NDArray[np.uint64]:
    """Bits of the three coordinates of the boxes' middles, interleaved, (n,)."""
    middle = 0.5 * (boxes[:, :3] + boxes[:, 3:])
    low, edge = middle.min(axis=0), np.ptp(middle, axis=0)
    cells = (middle - low) / np.where(edge > 0.0, edge, 1.0) * (2**_BITS - 1)
    code = np.zeros(len(boxes), np.uint64)
    for axis in range(3):
        bits = cells[:, axis].astype(np.uint64)
        for k in range(_BITS):
            code |= ((bits >> np.uint64(k)) & np.uint64(1)) << np.uint64(3 * k + axis)
    return code
