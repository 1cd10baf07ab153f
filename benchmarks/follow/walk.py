"""Conservative advancement along a delivered trajectory."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from benchmarks.follow.body import Follower
from benchmarks.follow.motion import beyond_limits, joint_bounds, postures

GRID_S = 12e-3
"""Postures are computed together on a grid at most this wide."""
AHEAD = 64
"""Intervals of the grid over which one bound on acceleration may reach."""
FLOOR_S = 1e-3
SLACK = 1e-7
"""Taken off every gap, m: normals are those of rounded nearest points."""


@dataclass(frozen=True)
class Followed:
    """What was met on the way.

    Attributes:
        least: smallest gap found, m; negative in a collision.
        queries: postures at which pairs were asked.
        asked: distances that were asked for.
        floored: steps that were longer than the gap allowed.
        outside: largest amount by which a position left its limits, or by which
            velocity or acceleration exceeded theirs (as a share of the limit).
    """

    least: float
    queries: int
    asked: int
    floored: int
    outside: float


def follow(document: dict[str, Any]) -> Followed:
    """Walk the delivered trajectory of a plan document."""
    t, q, qd = (np.array(document["trajectory"][k], float) for k in ("t", "q", "qd"))
    walk = _Walk(Follower(document), t, q, qd)
    walk.between(walk.along())
    outside = beyond_limits(document["robot"]["limits"], t, q, qd)
    return Followed(walk.least, walk.queries, walk.asked, walk.floored, outside)


class _Walk:
    """Every pair advances by itself; what was met so far."""

    def __init__(
        self, follower: Follower, t: np.ndarray, q: np.ndarray, qd: np.ndarray
    ) -> None:
        self.follower, self.rows = follower, (t, q, qd)
        solids = len(follower.solids)
        self.alone = len(follower.moving) * solids
        ways, every = np.repeat(follower.moving, solids), np.arange(solids)
        self.first = np.concatenate([ways, follower.pairs[:, 0]])
        each = np.tile(every, len(follower.moving))
        self.second = np.concatenate([each, follower.pairs[:, 1]])
        parts = np.ceil(np.diff(t) / GRID_S).astype(int)
        row = np.repeat(np.arange(len(parts)), parts)
        inside = np.arange(len(row)) - (np.cumsum(parts) - parts)[row]
        grid = t[row] + np.diff(t)[row] * inside / parts[row]
        self.grid = np.append(grid, t[-1])
        self.most = follower.accelerations(*joint_bounds(t, q, qd))[row]
        self.least, self.queries, self.asked, self.floored = np.inf, 0, 0, 0

    def along(self) -> list[tuple[np.ndarray, ...]]:
        """Advance on the grid; intervals, pairs and times where that is too coarse."""
        last, grid = len(self.grid) - 1, self.grid
        where, speed = self._at(grid)
        most = _ahead(self.most)
        alive = np.arange(len(self.first))
        index = np.zeros(len(alive), int)
        finer: list[tuple[np.ndarray, ...]] = []
        while alive.size:
            gap, opens = self._measure(alive, index, where, speed)
            a = self._bound(alive, np.minimum(index, last - 1), most)
            until = np.minimum(
                grid[index] + _valid(gap, opens, a),
                grid[np.minimum(index + AHEAD, last)],
            )
            reached = np.searchsorted(grid, until, side="right") - 1
            stuck = (reached <= index) & (index < last)
            if stuck.any():
                finer.append((index[stuck], alive[stuck], until[stuck]))
            go = index < last
            alive, index = alive[go], np.maximum(reached, index + 1)[go]
        return finer

    def between(self, finer: list[tuple[np.ndarray, ...]]) -> None:
        """Advance the pairs whose bound ends inside an interval of the grid."""
        if not finer:
            return
        where_to, pair, until = (
            np.concatenate(part) for part in zip(*finer, strict=True)
        )
        cells, group = np.unique(where_to, return_inverse=True)
        now = self.grid[cells]
        while True:
            now, go = self._on(cells, now, group, until)
            kept, order = go[group], np.cumsum(go) - 1
            pair, group = pair[kept], order[group[kept]]
            cells, now = cells[go], now[go]
            if not pair.size:
                return
            gap, opens = self._measure(pair, group, *self._at(now))
            a = self._bound(pair, cells[group], self.most)
            until = now[group] + _valid(gap, opens, a)

    def _on(
        self, cells: np.ndarray, now: np.ndarray, group: np.ndarray, until: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """The next time in each interval, and whether it is inside."""
        reach, end = np.full(len(cells), np.inf), self.grid[cells + 1]
        np.minimum.at(reach, group, until)
        self.floored += int(np.sum((reach - now < FLOOR_S) & (reach < end)))
        now = np.maximum(reach, now + FLOOR_S)
        return now, now < end

    def _at(self, times: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        self.queries += len(times)
        return self.follower.at(*postures(*self.rows, times))

    def _bound(self, pair: np.ndarray, at: np.ndarray, most: np.ndarray) -> np.ndarray:
        """Bound on how fast a gap's rate changes, m/s2."""
        found: np.ndarray = most[at, self.first[pair]]
        other = pair >= self.alone
        found[other] += most[at[other], self.second[pair[other]]]
        return found

    def _measure(
        self, pair: np.ndarray, at: np.ndarray, where: np.ndarray, speed: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Gap of every pair at its own posture ``at``, m, and its rate, m/s."""
        follower, one, other = self.follower, self.first[pair], self.second[pair]
        place, rate = where[at, one], speed[at, one]
        away, gaps = np.zeros((len(pair), 3)), np.zeros(len(pair))
        single = pair < self.alone
        alone = np.flatnonzero(single)
        if alone.size:
            asked = one[alone].tolist(), other[alone].tolist(), list(place[alone])
            found = [follower.gap(*each) for each in zip(*asked, strict=True)]
            gaps[alone] = [gap for gap, _ in found]
            away[alone] = place[alone] - np.array([point for _, point in found])
        two = np.flatnonzero(~single)
        i, j, two_at = one[two], other[two], at[two]
        away[two] = place[two] - where[two_at, j]
        rate[two] -= speed[two_at, j]
        apart = np.maximum(np.sqrt(np.einsum("pk,pk->p", away, away)), 1e-12)
        gaps[two] = apart[two] - follower.radii[i] - follower.radii[j]
        self.least = min(self.least, float(np.min(gaps, initial=np.inf)))
        self.asked += len(pair)
        return gaps, np.einsum("pk,pk->p", away, rate) / apart


def _valid(gap: np.ndarray, opens: np.ndarray, a: np.ndarray) -> np.ndarray:
    """How long ``gap + opens s - a s^2 / 2`` stays positive, s."""
    room = np.maximum(gap - SLACK, 0.0)
    return np.asarray((opens + np.sqrt(opens * opens + 2.0 * a * room)) / a)


def _ahead(most: np.ndarray) -> np.ndarray:
    """Largest of each row and the ``AHEAD - 1`` after it; AHEAD is a power of two."""
    found, reach = most.copy(), 1
    while reach < AHEAD:
        found[:-reach] = np.maximum(found[:-reach], found[reach:])
        reach *= 2
    return found
