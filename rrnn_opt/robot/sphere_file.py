"""Collision-sphere files: spheres a link, and the link pairs left unchecked.

    {"links": {link: [{"center": [x, y, z], "radius": r}, ...]},
     "disabled_self_collision_pairs": [[link, link, reason], ...]}

Centres are in the link's frame, m.  Every two links that have spheres and that
do not sit on the same joint are a self pair, minus the disabled ones.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np

from rrnn_opt.errors import DocumentError, RobotError, ShapeError
from rrnn_opt.files import read_json
from rrnn_opt.robot.placement import apply
from rrnn_opt.robot.tree import Array, Frame, Sphere, frozen

LinkPair = frozenset[str]
MOST = 5_000
"""Spheres of a robot that are accepted at most."""
LARGEST = 1e6
"""Largest coordinate and radius, m."""


@dataclass(frozen=True, eq=False)
class SphereFile:
    """What a sphere file says.

    Attributes:
        links: (center (3,), radius), m, of every link, in the link's frame.
        disabled: unordered link pairs that are not checked; None when the
            file does not say.
    """

    links: Mapping[str, Sequence[tuple[Array, float]]]
    disabled: frozenset[LinkPair] | None

    @staticmethod
    def from_data(data: Mapping[str, Any]) -> SphereFile:
        """What the parsed JSON of a sphere file says.

        Raises:
            KeyError, TypeError, ValueError, ShapeError: it makes no sense.
        """
        links = {
            str(link): tuple(_ball(entry) for entry in entries)
            for link, entries in data["links"].items()
        }
        count = sum(map(len, links.values()))
        if count > MOST:
            raise ValueError(f"{count} spheres; at most {MOST} are accepted")
        listed = data.get("disabled_self_collision_pairs")
        if listed is None:
            return SphereFile(links, None)
        return SphereFile(links, frozenset(frozenset((a, b)) for a, b, *_ in listed))


def read_sphere_file(path: str | Path) -> SphereFile:
    """Read and check a sphere file.

    Args:
        path: the file.

    Returns:
        Its contents.

    Raises:
        RobotError: it cannot be read, or an entry makes no sense.
    """
    try:
        data = read_json(path)
    except DocumentError as error:
        raise RobotError(str(path), f"not a readable sphere file: {error}") from None
    try:
        return SphereFile.from_data(data)
    except (
        LookupError,
        TypeError,
        ValueError,
        AttributeError,
        OverflowError,
        ShapeError,
    ) as error:
        message = f"not a sphere file, 'links' of spheres are expected ({error!r})"
        raise RobotError(str(path), message) from None


def _ball(entry: Mapping[str, Any]) -> tuple[Array, float]:
    center = frozen(entry["center"], (3,), "center")
    radius = float(entry["radius"])
    if not (np.all(np.abs(center) <= LARGEST) and 0.0 < radius <= LARGEST):
        raise ValueError("a sphere needs a finite center and a positive radius")
    return center, radius


def placed_spheres(
    links: Mapping[str, Sequence[tuple[Array, float]]], frames: Mapping[str, Frame]
) -> tuple[Sphere, ...]:
    """The spheres on the joints that carry their links.

    Args:
        links: (center, radius) of every link, in the link's frame, m.
        frames: frame of every link.

    Returns:
        The spheres, in the order of the links.

    Raises:
        KeyError: a link has no frame.
    """
    return tuple(
        Sphere(
            link,
            frames[link].joint,
            frozen(apply(frames[link].placement, center), (3,), link),
            radius,
        )
        for link, balls in links.items()
        for center, radius in balls
    )


def checked_pairs(
    spheres: Iterable[Sphere], disabled: frozenset[LinkPair]
) -> tuple[tuple[str, str], ...]:
    """Pairs of links with spheres on different joints, minus the disabled ones."""
    joint = {sphere.link: sphere.joint for sphere in spheres}
    return tuple(
        (first, second)
        for first, second in combinations(joint, 2)
        if joint[first] != joint[second] and frozenset((first, second)) not in disabled
    )
