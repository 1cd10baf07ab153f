"""Balls that hold several spheres of one body: first, coarse looks at it.

A ball rides on the same joint as the spheres it holds, so it is simply one more
sphere of the robot.  No sphere that it holds can be nearer to anything than it.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.check.arithmetic.doubles import GROW
from rrnn_opt.check.plans.reading import Array
from rrnn_opt.check.plans.robot.model import Model

Index = NDArray[np.int64]
CELL = 4
"""A body of more spheres is split along its longest side, and again."""


@dataclass(frozen=True, eq=False)
class Bodies:
    """A robot with balls after its own spheres.

    Attributes:
        model: ns spheres, then a ball a cell, then a ball a body.
        ns: number of the robot's own spheres.
        cell: index of the ball that holds each sphere in its cell, (ns,).
        body: index of the ball that holds each sphere's whole body, by the
            index of a sphere or a cell's ball.
    """

    model: Model
    ns: int
    cell: Index
    body: Index


def with_balls(model: Model) -> Bodies:
    """Add the balls; a body is what shares link and joint."""
    ns, groups = len(model.links), _bodies(model)
    cells = [cell for group in groups for cell in _cells(model.centres, group)]
    body = _labels(ns, groups) + ns + len(cells)
    wider = _with(model, [*cells, *groups])
    held = np.append(body, [body[cell[0]] for cell in cells]).astype(np.int64)
    return Bodies(wider, ns, _labels(ns, cells) + ns, held)


def _bodies(model: Model) -> list[Index]:
    groups: dict[tuple[str, int], list[int]] = {}
    for i, key in enumerate(zip(model.links, model.carrier.tolist(), strict=True)):
        groups.setdefault(key, []).append(i)
    return [np.array(group, dtype=np.int64) for group in groups.values()]


def _cells(centres: Array, group: Index) -> Iterable[Index]:
    if len(group) <= CELL:
        return [group]
    mine = centres[group]
    side = int(np.argmax(np.ptp(mine, axis=0)))
    order = group[np.argsort(mine[:, side], kind="stable")]
    half = len(order) // 2
    return [*_cells(centres, order[:half]), *_cells(centres, order[half:])]


def _labels(ns: int, groups: list[Index]) -> Index:
    labels = np.zeros(ns, dtype=np.int64)
    for k, group in enumerate(groups):
        labels[group] = k
    return labels


def _with(model: Model, groups: list[Index]) -> Model:
    """A ball for each group (not the least one), after all spheres."""
    c, r = model.centres, model.radii
    middles = [(c[g].min(axis=0) + c[g].max(axis=0)) / 2 for g in groups]
    radii = [
        float((np.sqrt(np.sum((c[g] - m) ** 2, axis=1)) + r[g]).max()) * GROW
        for g, m in zip(groups, middles, strict=True)
    ]
    first = [int(g[0]) for g in groups]
    return replace(
        model,
        links=(*model.links, *(model.links[i] for i in first)),
        carrier=np.append(model.carrier, model.carrier[first]).astype(np.int64),
        centres=np.concatenate([c, np.reshape(middles, (-1, 3))]),
        radii=np.append(r, radii),
    )
