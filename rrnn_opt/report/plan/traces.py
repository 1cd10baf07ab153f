"""What the search left behind: the tool traces of both trees."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.report.plan.pose import joint_frames, tip_positions

Array = NDArray[np.float64]

PIECES = 4
"""Straight pieces drawn between a node and its parent."""
SIDES = ("start", "goal")


def tool_traces(document: Mapping[str, Any]) -> dict[str, Array]:
    """Tip positions along the edges of the trees that a plan result kept.

    A straight line in joint space is drawn between a node and its parent,
    ``PIECES`` pieces of it: the nodes of a slide stand close together.

    Args:
        document: plan result; without ``trees`` there are no traces.

    Returns:
        For "start" and "goal" the ends of the pieces, (k, 2, 3), m.
    """
    kept = document.get("trees") or {}
    return {
        side: _pieces(document["robot"], kept[side])
        for side in SIDES
        if len((kept.get(side) or {}).get("q", ())) > 1
    }


def _pieces(robot: dict[str, Any], tree: Mapping[str, Any]) -> Array:
    q = np.asarray(tree["q"], dtype=float)
    parents = np.asarray(tree["parents"], dtype=int)
    children = np.flatnonzero(parents >= 0)
    if not len(children):
        return np.zeros((0, 2, 3))
    share = np.linspace(0.0, 1.0, PIECES + 1)[:, None, None]
    between = q[parents[children]] * (1.0 - share) + q[children] * share
    frames = joint_frames(robot, between.reshape(-1, q.shape[1]))
    tip = tip_positions(robot, frames).reshape(PIECES + 1, -1, 3)
    return np.stack([tip[:-1], tip[1:]], axis=2).reshape(-1, 2, 3)
