"""The collision body of a URDF robot: from a sphere file, or by covering.

Without a sphere file, two links that a joint of the URDF connects are left
unchecked, and so are links on the same moving joint; every other pair is a self
pair.  Nothing is guessed from contact in some posture.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from rrnn_opt.errors import RobotError
from rrnn_opt.robot.cover import Cover, cover_box, cover_cylinder
from rrnn_opt.robot.data import RobotData
from rrnn_opt.robot.loading.urdf import Urdf
from rrnn_opt.robot.loading.urdf_shapes import Primitive
from rrnn_opt.robot.placement import apply, compose, shift, turn
from rrnn_opt.robot.sphere_file import checked_pairs, placed_spheres, read_sphere_file
from rrnn_opt.robot.tree import Array

INFLATION = 0.01  # m, wanted of the covers of cylinders' sides and boxes


def collision_body(
    robot: RobotData, urdf: Urdf, spheres: str | Path | None
) -> RobotData:
    """The robot with its collision spheres and self pairs.

    Args:
        robot: the robot, its frames named like the URDF's links.
        urdf: where it comes from.
        spheres: sphere file; without it the primitives are covered.

    Returns:
        The robot.  ``cover["inflation_m"]`` is there when something was covered,
        ``cover["missing"]`` when links have a mesh for which there are no
        spheres, or when there is no collision geometry at all (all links).

    Raises:
        RobotError: the sphere file cannot be read or names an unknown link.
    """
    if spheres is not None:
        return _from_file(robot, urdf, spheres)
    covered = {
        link: [(part, _cover(part)) for part in parts if part.kind != "mesh"]
        for link, parts in urdf.collisions.items()
    }
    links = {
        link: [ball for part, cover in parts for ball in _balls(part, cover)]
        for link, parts in covered.items()
    }
    placed = placed_spheres(links, {frame.name: frame for frame in robot.frames})
    adjacent = frozenset(frozenset((a, b)) for _, a, b in urdf.joints)
    inflations = [c.inflation for parts in covered.values() for _, c in parts]
    return replace(
        robot,
        spheres=placed,
        self_pairs=checked_pairs(placed, adjacent),
        cover=_report(inflations, _missing(urdf)),
    )


def _from_file(robot: RobotData, urdf: Urdf, spheres: str | Path) -> RobotData:
    file = read_sphere_file(spheres)
    frames = {frame.name: frame for frame in robot.frames}
    unknown = [
        link for link, balls in file.links.items() if balls and link not in frames
    ]
    if unknown:
        message = f"the sphere file {spheres} names '{unknown[0]}', not a link of it"
        raise RobotError(urdf.path, message)
    placed = placed_spheres(file.links, frames)
    adjacent = frozenset(frozenset((a, b)) for _, a, b in urdf.joints)
    disabled = adjacent if file.disabled is None else file.disabled
    return replace(robot, spheres=placed, self_pairs=checked_pairs(placed, disabled))


def _missing(urdf: Urdf) -> list[str]:
    if not urdf.collisions:
        return list(urdf.links)
    return [
        link
        for link, parts in urdf.collisions.items()
        if any(part.kind == "mesh" for part in parts)
    ]


def _report(inflations: list[float], missing: list[str]) -> dict[str, Any]:
    report: dict[str, Any] = {}
    if inflations:
        report["inflation_m"] = (min(inflations), max(inflations))
    if missing:
        report["missing"] = missing
    return report


def _cover(part: Primitive) -> Cover:
    if part.kind == "sphere":
        return Cover(np.zeros((1, 3)), part.size[0], 0.0)
    if part.kind == "cylinder":
        return cover_cylinder(*part.size, inflation=INFLATION)
    return cover_box(part.size, inflation=INFLATION)


def _balls(part: Primitive, cover: Cover) -> Iterator[tuple[Array, float]]:
    roll, pitch, yaw = (math.degrees(angle) for angle in part.rpy)
    rotation = compose(turn("z", yaw), turn("y", pitch), turn("x", roll))
    pose = compose(shift(*part.xyz), rotation)
    for center in cover.centers:
        yield apply(pose, center), cover.radius
