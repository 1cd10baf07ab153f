"""Boxes of a proof tree, found again from its cuts.

A tree is one byte a node, level by level: below 250 the number of the input
element along which the box is halved, 254 or 255 a leaf.  The first box holds
the claim's domain, every other one is half of its parent, so the leaves cover
the domain whatever the bytes are.
"""

from __future__ import annotations

import base64
import hashlib
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.check.arithmetic.intervals import Array
from rrnn_opt.check.claims.document import WHERE, Bound, ClaimGraph
from rrnn_opt.errors import DocumentError, UndecidedError

NATURAL, MEAN_VALUE, FIRST_LEAF = 255, 254, 250
MOST_NODES = 50_000_000


@dataclass(frozen=True, eq=False)
class Leaves:
    """Boxes without further cuts.

    Attributes:
        lower: (n, B).
        upper: (n, B).
        plain: shown by the natural form alone, says the finder, (B,).
    """

    lower: Array
    upper: Array
    plain: NDArray[np.bool_]


def read_tree(payload: Any) -> NDArray[np.uint8]:
    """The bytes of a tree.

    Raises:
        DocumentError: they are not readable.
        UndecidedError: they are not those that the payload's digest names.
    """
    try:
        packed = base64.b64decode(payload["tree"], validate=True)
        unpack = zlib.decompressobj()
        data = unpack.decompress(packed, MOST_NODES)
        nodes, digest = int(payload["nodes"]), str(payload["sha256"])
    except (KeyError, TypeError, ValueError, zlib.error) as error:
        raise DocumentError(WHERE, f"tree not readable ({error!r})") from error
    whole = unpack.eof and not unpack.unused_data and len(data) == nodes
    if not whole or hashlib.sha256(data).hexdigest() != digest:
        raise UndecidedError("the tree is not the one whose digest is given")
    return np.frombuffer(data, np.uint8)


def leaves(graph: ClaimGraph, codes: NDArray[np.uint8]) -> Leaves:
    """Replay all cuts.

    Raises:
        UndecidedError: the tree is not whole, leaves boxes open, or a variable
            has no bounds.
    """
    low, high = (np.array(side)[:, None] for side in domain_box(graph))
    lows, highs, plain = [], [], []
    read = 0
    while low.shape[1]:
        level = codes[read : read + low.shape[1]]
        read += low.shape[1]
        cut, axes = level < FIRST_LEAF, level[level < FIRST_LEAF]
        if len(level) != low.shape[1] or np.any(axes >= len(low)):
            raise UndecidedError("the tree is not whole")
        if not np.all(cut | (level >= MEAN_VALUE)):
            raise UndecidedError("the tree leaves boxes open")
        lows.append(low[:, ~cut])
        highs.append(high[:, ~cut])
        plain.append(level[~cut] == NATURAL)
        low, high = halves(low[:, cut], high[:, cut], axes.astype(np.intp))
    if read != len(codes):
        raise UndecidedError("the tree has more nodes than boxes")
    return Leaves(np.hstack(lows), np.hstack(highs), np.concatenate(plain))


def halves(low: Array, high: Array, axes: NDArray[np.intp]) -> tuple[Array, Array]:
    """Both halves of every box; any number between the ends may be the cut.

    Raises:
        UndecidedError: a box has no number between its ends.
    """
    box = np.arange(low.shape[1])
    first, last = low[axes, box], high[axes, box]
    cut = first + 0.5 * (last - first)
    if not np.all((first <= cut) & (cut <= last)):
        raise UndecidedError("a box is too small or too large to be halved")
    left, right = high.copy(), low.copy()
    left[axes, box], right[axes, box] = cut, cut
    lows, highs = np.stack([low, right], axis=2), np.stack([left, high], axis=2)
    return lows.reshape(len(low), -1), highs.reshape(len(low), -1)


def domain_box(graph: ClaimGraph) -> tuple[list[float], list[float]]:
    """Doubles around the domain, all elements of all variables in order.

    Raises:
        UndecidedError: an element has no bound.
    """
    lower, upper = [], []
    domain: Mapping[Any, tuple[Bound, Bound]] = graph.domain
    for index, port in enumerate(graph.inputs):
        for element in range(port.size):
            low, high = domain.get((index, element), (None, None))
            if low is None or high is None:
                raise UndecidedError(
                    f"'{port.name}' has no bounds: intervals need them"
                )
            lower.append(_outward(low, -1))
            upper.append(_outward(high, 1))
    return lower, upper


def _outward(number: Fraction, side: int) -> float:
    """A double that is no less (side 1) or no more (side -1)."""
    try:
        near = float(number)
    except OverflowError:
        raise UndecidedError("a bound is too large for doubles") from None
    inside = (Fraction(near) - number) * side < 0
    return float(np.nextafter(near, side * np.inf)) if inside else near
