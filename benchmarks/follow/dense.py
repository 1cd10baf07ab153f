"""Samples so dense that nothing needs to be argued."""

from __future__ import annotations

from typing import Any

import numpy as np

from benchmarks.follow.body import Follower
from benchmarks.follow.motion import joint_bounds, postures


def sampled(document: dict[str, Any], step_rad: float = 1e-3) -> float:
    """Least gap at samples at most ``step_rad`` of any joint apart, m.

    A pair is asked again when its sphere has moved by as much as its gap was.
    """
    t, q, qd = (np.array(document["trajectory"][k], float) for k in ("t", "q", "qd"))
    follower, least = Follower(document), np.inf
    count = (len(follower.radii), len(follower.solids))
    gaps, asked = np.zeros(count), np.zeros((*count, 3))
    i, j = follower.pairs.T
    fastest = joint_bounds(t, q, qd)[0].max(axis=1)
    for row, h in enumerate(np.diff(t)):
        times = t[row] + np.linspace(0.0, h, 2 + int(fastest[row] * h / step_rad))
        for where in follower.at(*postures(t, q, qd, times))[0]:
            apart = np.linalg.norm(where[i] - where[j], axis=1)
            room = apart - follower.radii[i] - follower.radii[j]
            least = min(least, float(np.min(room, initial=np.inf)))
            moved = np.linalg.norm(where[:, None] - asked, axis=2)
            stale = (moved >= gaps) & (follower.joints >= 0)[:, None]
            for sphere, solid in np.argwhere(stale):
                gap, _ = follower.gap(int(sphere), int(solid), where[sphere])
                gaps[sphere, solid], asked[sphere, solid] = gap, where[sphere]
                least = min(least, gap)
    return least
