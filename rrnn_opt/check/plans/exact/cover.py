"""Whether what was proved leaves nothing out: times, pairs, spheres."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from rrnn_opt.check.plans.collision.targets import Target
from rrnn_opt.check.plans.collision.worklist import Leaf


def covered(targets: Sequence[Target], leaves: Sequence[Leaf], pieces: int) -> bool:
    """Whether the boxes cover [0, 1] of every piece, for every pair of spheres.

    Sums and comparisons of dyadic numbers of 50 bits are exact.
    """
    for target in targets:
        chain = [target]
        while (finer := chain[-1].finer) is not None:
            chain.append(finer.target)
        rows = [_fine_rows(leaf, chain) for leaf in leaves if leaf.target in chain]
        if target.count and not tiled(rows, chain[-1].count, pieces):
            return False
    return True


def _fine_rows(leaf: Leaf, chain: list[Target]) -> Any:
    """(pair * pieces.., start, end) of a leaf in terms of single spheres."""
    box, pair = leaf.box, leaf.pair
    for level in chain[chain.index(leaf.target) : -1]:
        if level.finer is not None:
            box, pair = level.finer.rows(box, pair)
    middle, half = leaf.boxes.middle[box], leaf.boxes.half[box]
    return np.stack([leaf.boxes.piece[box], pair, middle - half, middle + half])


def tiled(rows: list[Any], pairs: int, pieces: int) -> bool:
    """Whether rows (piece, pair, start, end) cover [0, 1] for all of both.

    Args:
        rows: arrays of four rows each.
        pairs: number of pairs.
        pieces: number of pieces.
    """
    if not rows:
        return False
    piece, pair, start, end = np.concatenate(rows, axis=1)
    key = piece * pairs + pair
    order = np.lexsort((start, key))
    key, start, end = key[order], start[order], end[order]
    first = np.append(True, key[1:] != key[:-1])
    last = np.append(first[1:], True)
    joined = first[1:] | (start[1:] == end[:-1])
    whole = np.all(start[first] == 0.0) and np.all(end[last] == 1.0)
    return bool(whole and np.all(joined) and first.sum() == pairs * pieces)


def nested(targets: Sequence[Target]) -> set[tuple[int, int]]:
    """(ball, sphere) wherever a coarse pair stands for a pair of spheres."""
    found: set[tuple[int, int]] = set()
    for target in targets:
        level: Target = target
        while level.finer is not None:
            outer = pair = np.arange(level.count)
            finest = level
            while (finer := finest.finer) is not None:
                outer, pair = finer.rows(outer, pair)
                finest = finer.target
            sides = zip(level.spheres, finest.spheres, strict=True)
            for balls, held in sides:
                rows = np.stack([balls[outer], held[pair]], axis=1)
                found |= {(int(a), int(b)) for a, b in np.unique(rows, axis=0)}
            level = level.finer.target
    return found


def spheres(target: Target, pair: int) -> list[int]:
    """The spheres of one pair: one, or two of a self pair."""
    return [int(side[pair]) for side in target.spheres]
