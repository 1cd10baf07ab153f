"""A scene as the rows that compiled code reads.

A *solid* is what the code asks for one distance: a shape, one ball of a cloud,
or a hull.  A shape is one packed row; a hull is a header row, whose entry 12 is
the number of its facets, followed by one half-space row a facet: its distance
is the largest of theirs.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.scene.distance import PRIMITIVES
from rrnn_opt.scene.mesh import Mesh
from rrnn_opt.scene.points import Points
from rrnn_opt.scene.scene import Member, Scene
from rrnn_opt.scene.shapes import PACKED, Box, HalfSpace, Sphere

Array = NDArray[np.float64]
Index = NDArray[np.int32]

HULL = "hull"
SOLIDS = (*PRIMITIVES, HULL)
"""Kinds of solids in the order of the numbers that compiled code uses."""


@dataclass(frozen=True, eq=False)
class Records:
    """The solids of a scene; those without bounds come first.

    Attributes:
        kind: index into ``SOLIDS``, (n,).
        first: row of each solid, (n,).
        rows: packed shapes, (m, 16).
        bounds: least and greatest coordinates, (n, 6), m; infinite without.
        owner: index of the obstacle that the solid belongs to, (n,).
        unbounded: number of solids without bounds.
    """

    kind: Index
    first: Index
    rows: Array
    bounds: Array
    owner: Index
    unbounded: int


def records(scene: Scene) -> Records:
    """The solids of a scene."""
    kinds: list[Index] = [np.zeros(0, np.int32)]
    sizes: list[Index] = [np.zeros(0, np.int32)]
    owners: list[Index] = [np.zeros(0, np.int32)]
    rows, bounds = [np.zeros((0, PACKED))], [np.zeros((0, 6))]
    for index, member in enumerate(scene):
        packed = member.pack().reshape(-1, PACKED)
        count = len(packed) if isinstance(member, Points) else 1
        kinds.append(np.full(count, _solid(member), np.int32))
        sizes.append(np.full(count, len(packed) // count, np.int32))
        owners.append(np.full(count, index, np.int32))
        rows.append(packed)
        bounds.append(_bounds(member).reshape(count, 6))
    size, box = np.concatenate(sizes), np.concatenate(bounds)
    first = np.cumsum(size) - size
    endless = ~np.all(np.isfinite(box), axis=1)
    order = np.argsort(~endless, kind="stable")
    return Records(
        kind=np.concatenate(kinds)[order],
        first=first[order].astype(np.int32),
        rows=np.concatenate(rows),
        bounds=np.ascontiguousarray(box[order]),
        owner=np.concatenate(owners)[order],
        unbounded=int(endless.sum()),
    )


def _solid(member: Member) -> int:
    names = {"mesh": HULL, "points": "sphere"}
    return SOLIDS.index(names.get(member.kind, member.kind))


def _bounds(member: Member) -> Array:
    """Boxes around the solids of an obstacle: (lows, highs), (n, 6), m."""
    if isinstance(member, HalfSpace):
        return np.array([[-np.inf] * 3 + [np.inf] * 3])
    if isinstance(member, Mesh):
        return member.bounds().reshape(1, 6)
    if isinstance(member, Points):
        return np.hstack(
            [member.centers - member.radius, member.centers + member.radius]
        )
    turned = np.abs(member.rotation)
    if isinstance(member, Box):
        half = turned @ (0.5 * member.size)
    elif isinstance(member, Sphere):
        half = np.full(3, member.radius)
    else:
        half = turned[:, 2] * (0.5 * member.length) + member.radius
    return np.concatenate([member.position - half, member.position + half])[None]
