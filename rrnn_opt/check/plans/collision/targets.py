"""What must stay apart: spheres from obstacles, spheres from one another.

Each target numbers its pairs 0, 1, .. and answers, for rows (box, pair):
the distance at the box's middle, a cheap bound over the box (distance minus
travel), and a sharp one,

    gap - |n'J v tau| - |n'J a tau^2 / 2| - |n'J j tau^3 / 6| - B(h) / 2,

the terms being those of the joints' exact cubics.  A convex obstacle lies in
a half-space with normal n, so the sharp bound holds for the whole box.  A
coarse target speaks of balls that hold several spheres of one body; what it
cannot settle goes to the pairs of its ``finer`` one.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple, Protocol

import numpy as np

from rrnn_opt.check.plans.collision.boxes import Index, Poses
from rrnn_opt.check.plans.reading import Array


class FirstLook(NamedTuple):
    """All pairs in all boxes, solid by solid: pair = solid times S plus own.

    Attributes:
        d: distance at the middle, (O, S, B), m.
        shown: cheap bound over the box, (O, S, B), m.
    """

    d: Array
    shown: Array


class Target(Protocol):
    """Pairs that must keep at least ``required`` metres apart."""

    @property
    def required(self) -> float:
        """Least distance, m."""

    @property
    def slack(self) -> Array:
        """No bound or distance given here is off by more, one a solid, (O,), m."""

    @property
    def count(self) -> int:
        """Number of pairs."""

    @property
    def spheres(self) -> tuple[Index, ...]:
        """The spheres of each pair: one, or two of a self pair, (count,) each."""

    @property
    def finer(self) -> Finer | None:
        """Where the pairs are taken apart; None if they are single spheres."""

    def room(self, pair: Index) -> Array:
        """The slack of each pair, (M,), or of all, (1,), m."""

    def first(self, poses: Poses) -> FirstLook:
        """All pairs in all boxes."""

    def travel(self, poses: Poses, box: Index, pair: Index) -> Array:
        """How far the pair can approach inside the box, (M,), m."""

    def distance(self, poses: Poses, box: Index, pair: Index) -> Array:
        """Signed distance at the middle, (M,), m."""

    def floor(self, poses: Poses, box: Index, pair: Index, d: Array) -> Array:
        """Lower bound of the distance at the middle, d or less, (M,), m."""

    def sharp(self, poses: Poses, box: Index, pair: Index) -> Array:
        """Lower bound of the distance over the whole box, (M,), m."""

    def label(self, pair: int) -> list[str]:
        """The two names of a pair."""


@dataclass(frozen=True, eq=False)
class Finer:
    """The pairs that those of a coarse target stand for, the same for each solid.

    Attributes:
        target: of single spheres, or of smaller balls.
        pairs: its pairs with the first solid, in the order of the coarse ones.
        sizes: how many each coarse pair with that solid has.
        width: coarse pairs of one solid.
        finer_width: finer pairs of one solid.
    """

    target: Target
    pairs: Index
    sizes: Index
    width: int
    finer_width: int

    @cached_property
    def first(self) -> Index:
        """Where each coarse pair's own begin, (width,)."""
        return np.cumsum(self.sizes) - self.sizes

    def rows(self, box: Index, pair: Index) -> tuple[Index, Index]:
        """Rows (box, pair) of the finer target for rows of the coarse one."""
        solid, own = np.divmod(pair, self.width)
        sizes = self.sizes[own]
        ends = np.cumsum(sizes)
        begin = self.first[own] - (ends - sizes)
        inner = np.arange(int(sizes.sum())) + np.repeat(begin, sizes)
        shift = np.repeat(solid * self.finer_width, sizes)
        return np.repeat(box, sizes), self.pairs[inner] + shift
