"""Where spheres of two links overlap while their geometry is apart.

Such a false contact forbids a posture that the robot can take.  Where two links
pass each other closely false contacts can cut joint space to pieces, so the balls
that make most of them are made smaller, at the price of more of them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.robot.fitting.geometry import Gap, Geometry
from rrnn_opt.robot.fitting.link_cover import CoveredLink
from rrnn_opt.robot.fitting.sampled import Sampled
from rrnn_opt.robot.fitting.solid_cover import Burden
from rrnn_opt.robot.tree import Array

Pair = tuple[str, str]
Marks = NDArray[np.bool_]


@dataclass(frozen=True)
class SelfContact:
    """How often a robot touches itself in random postures.

    Attributes:
        postures: their number.
        spheres: share in which spheres of checked links overlap.
        geometry: share in which geometry of checked links touches.
    """

    postures: int
    spheres: float
    geometry: float

    @property
    def false(self) -> float:
        """Share that the spheres forbid and the geometry does not."""
        return self.spheres - self.geometry


class PairContact:
    """Sphere and geometry contacts of two links in sampled postures.

    Geometry is asked for once a posture, and only where spheres overlap, for they
    hold the geometry.

    Args:
        first: balls of one link.
        second: of the other.
        geometry: of both.
        sampled: the postures.
    """

    def __init__(
        self,
        first: CoveredLink,
        second: CoveredLink,
        geometry: Mapping[str, list[Geometry]],
        sampled: Sampled,
    ) -> None:
        self.first, self.second, self.sampled = first, second, sampled
        self.links = first, second
        self._gap = Gap(geometry[first.name], geometry[second.name])
        self._asked: Marks = np.zeros(sampled.count, dtype=bool)
        self.touch: Marks = np.zeros(sampled.count, dtype=bool)
        self.look()

    @property
    def names(self) -> Pair:
        """Of both links."""
        return self.first.name, self.second.name

    def _overlapping(self) -> Marks:
        """Postures in which balls of both overlap, (count,)."""
        (a, r), (b, s) = self.first.placed(), self.second.placed()
        every = np.arange(self.sampled.count)
        at = self.sampled.points(self.first.name, a, every)
        to = self.sampled.points(self.second.name, b, every)
        square = np.einsum("kni,kni->kn", at, at)[:, :, None]
        square = square + np.einsum("kni,kni->kn", to, to)[:, None]
        square -= 2.0 * np.matmul(at, to.transpose(0, 2, 1))
        return np.asarray(np.any(square < (r[:, None] + s) ** 2, axis=(1, 2)))

    def look(self) -> None:
        """See which postures are contacts with the balls as they are now."""
        self.overlap: Marks = self._overlapping()
        for k in np.flatnonzero(self.overlap & ~self._asked):
            poses = (self.sampled.poses[link.name][k] for link in self.links)
            self.touch[k] = self._gap.touching(*poses)
        self._asked |= self.overlap
        self.apart = np.flatnonzero(self.overlap & ~self.touch)

    @property
    def share(self) -> float:
        """Share of postures with a false contact."""
        return len(self.apart) / self.sampled.count

    def intruders(self, link: CoveredLink) -> tuple[Array, Array]:
        """Balls of the other link where there ever was a false contact.

        Returns:
            Centres in the frame of ``link``, (k, n, 3), and radii (n,), m.
        """
        other = self.second if link is self.first else self.first
        centers, radii = other.placed()
        where = np.flatnonzero(self._asked & ~self.touch)
        pose = self.sampled.poses[link.name][where]
        at = self.sampled.points(other.name, centers, where)
        at = np.einsum("kji,knj->kni", pose[:, :3, :3], at - pose[:, None, :3, 3])
        return at, radii


def refine(contacts: list[PairContact], *, extra: int, share: float) -> None:
    """Make balls smaller where they make false contacts.

    Of the pair with most of them, the ball that the other link's balls enter most
    has its part cut in two, so that the cover stays one; this goes on until no pair
    has more than a share of them, or all balls are spent.

    Args:
        contacts: of all pairs that are checked; changed.
        extra: balls added at most.
        share: of the postures, that no pair's false contacts need to go below.
    """
    added = 0
    while contacts and added < extra:
        pair = max(contacts, key=lambda contact: contact.share)
        if pair.share <= share:
            break
        link, index = _worst(pair)
        touched = [contact for contact in contacts if link in contact.links]
        before = len(link.bulges())
        link.refine(index, _burden(link, touched))
        added += max(1, len(link.bulges()) - before)
        for contact in touched:
            contact.look()


def _worst(contact: PairContact) -> tuple[CoveredLink, int]:
    """The ball of two links that is to be refined: most entered, most bulging."""
    best: tuple[float, CoveredLink, int] | None = None
    for link in contact.links:
        burden = _burden(link, [contact])
        balls = zip(*link.placed(), link.bulges(), strict=True)
        score = [burden(center, radius) * bulge for center, radius, bulge in balls]
        index = int(np.argmax(score))
        if best is None or score[index] > best[0]:
            best = (score[index], link, index)
    assert best is not None
    return best[1], best[2]


def _burden(link: CoveredLink, contacts: Sequence[PairContact]) -> Burden:
    """How deep other links' balls enter a ball, given its centre and radius, m.

    Summed over all postures that ever had a false contact.
    """
    found = [contact.intruders(link) for contact in contacts]
    centers = np.concatenate([at.reshape(-1, 3) for at, _ in found])
    radii = np.concatenate([np.tile(r, len(at)) for at, r in found])

    def burden(center: Array, radius: float) -> float:
        away = np.linalg.norm(centers - center, axis=1)
        return float(np.maximum(radius + radii - away, 0.0).sum())

    return burden


def self_contact(marks: Iterable[tuple[Marks, Marks]], postures: int) -> SelfContact:
    """Contacts of several pairs together.

    Args:
        marks: postures in which spheres overlap, and geometry touches, of each pair.
        postures: their number.
    """
    none = np.zeros(postures, dtype=bool)
    every = zip((none, none), *marks, strict=True)
    spheres, touch = (float(np.any(each, axis=0).mean()) for each in every)
    return SelfContact(postures, spheres, touch)
