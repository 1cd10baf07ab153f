"""What the built-in robots are put together from."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import ArrayLike

from rrnn_opt.robot.cover import Cover
from rrnn_opt.robot.tree import (
    REVOLUTE,
    Array,
    Frame,
    JointTree,
    Limits,
    Sphere,
    frozen,
    indices,
)


def chain(
    placements: Sequence[Array],
    axes: Sequence[Sequence[float]],
    types: Sequence[str] | None = None,
) -> JointTree:
    """A serial chain without mimic joints.

    Args:
        placements: each joint's pose in the one before, (4, 4), m.
        axes: unit axes in the joint frames, (3,).
        types: of the joints; all revolute when left out.

    Returns:
        The tree.
    """
    n = len(placements)
    return JointTree(
        parents=indices(range(-1, n - 1)),
        types=tuple(types or [REVOLUTE] * n),
        placements=frozen(placements, (n, 4, 4), "placements"),
        axes=frozen(axes, (n, 3), "axes"),
        source=indices(range(n)),
        multiplier=frozen(np.ones(n), (n,), "multiplier"),
        offset=frozen(np.zeros(n), (n,), "offset"),
    )


def limits(
    lower: ArrayLike, upper: ArrayLike, velocity: ArrayLike, acceleration: ArrayLike
) -> Limits:
    """Limits from plain numbers, (nv,) each; rad or m, per s, per s2."""
    n = len(np.atleast_1d(lower))
    return Limits(
        frozen(lower, (n,), "lower"),
        frozen(upper, (n,), "upper"),
        frozen(velocity, (n,), "velocity"),
        frozen(acceleration, (n,), "acceleration"),
    )


def frame(name: str, joint: int, placement: Array) -> Frame:
    """A frame on a joint (-1: the base); placement (4, 4), m."""
    return Frame(name, joint, frozen(placement, (4, 4), name))


def spheres(link: str, joint: int, cover: Cover) -> Iterable[Sphere]:
    """The spheres of a cover, as collision spheres of a link."""
    for center in cover.centers:
        yield Sphere(link, joint, frozen(center, (3,), link), cover.radius)


def inflations(covers: Iterable[Cover]) -> dict[str, tuple[float, float]]:
    """The entry ``cover`` of a robot: least and most inflation, m."""
    each = [cover.inflation for cover in covers]
    return {"inflation_m": (min(each), max(each))}
