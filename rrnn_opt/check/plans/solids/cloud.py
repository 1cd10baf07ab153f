"""Distance to the nearest of very many points, block by block."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.check.plans.reading import Array

BLOCK = 64
_CHUNK = 256


class Cloud:
    """Points in blocks of neighbours; a block is asked only if it may be nearest.

    Args:
        points: (n, 3), m.
    """

    def __init__(self, points: Array) -> None:
        blocks = _split(points)
        short = BLOCK - np.array([len(b) for b in blocks])
        # a block that is not full repeats one of its points
        padded = [
            np.concatenate([b, np.repeat(b[:1], k, axis=0)])
            for b, k in zip(blocks, short, strict=True)
        ]
        self.blocks: Array = np.array(padded)
        self.low, self.high = self.blocks.min(axis=1), self.blocks.max(axis=1)
        self.size = float(np.abs(points).max())

    def nearest(self, query: Array) -> tuple[Array, Array]:
        """Distance (M,) and direction away from it (M, 3) of the nearest point."""
        far, spot = np.empty(len(query)), np.empty((len(query), 3))
        for i in range(0, len(query), _CHUNK):
            rows = slice(i, i + _CHUNK)
            far[rows], spot[rows] = self._look(query[rows])
        away = query - spot
        usual = far > 1e-100
        unit = np.where(
            usual[:, None], away / np.where(usual, far, 1.0)[:, None], (1.0, 0.0, 0.0)
        )
        return far, unit

    def _look(self, query: Array) -> tuple[Array, Array]:
        out = np.maximum(self.low - query[:, None], query[:, None] - self.high)
        least = np.linalg.norm(np.maximum(out, 0.0), axis=2)
        first = np.argmin(least, axis=1)
        bound = self._inside(query, first)[0]
        near = least <= bound[:, None]
        near[np.arange(len(query)), first] = True  # whatever rounding or NaN say
        row, block = np.nonzero(near)
        far, spot = self._inside(query[row], block)
        order = np.lexsort((far, row))
        best = order[np.unique(row[order], return_index=True)[1]]
        return far[best], spot[best]

    def _inside(self, query: Array, block: NDArray[np.intp]) -> tuple[Array, Array]:
        """Nearest point of one block for each row."""
        points = self.blocks[block]
        away = points - query[:, None]
        square = np.einsum("mki,mki->mk", away, away)
        best, every = np.argmin(square, axis=1), np.arange(len(query))
        return np.sqrt(square[every, best]), points[every, best]


def _split(points: Array) -> list[Array]:
    """Halves across the longest edge of their box, until blocks are small."""
    stack, done = [points], []
    while stack:
        part = stack.pop()
        if len(part) <= BLOCK:
            done.append(part)
            continue
        axis = int(np.argmax(np.ptp(part, axis=0)))
        order = np.argpartition(part[:, axis], len(part) // 2)
        stack += [part[order[: len(part) // 2]], part[order[len(part) // 2 :]]]
    return done
