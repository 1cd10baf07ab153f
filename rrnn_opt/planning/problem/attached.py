"""Objects that move with a frame of the robot, as spheres of links of their own.

An attached object becomes a link: spheres that contain it, on the joint that
carries its frame.  It is checked against all obstacles and against every link
that sits on another joint, and so is every two attached objects on different
joints.  Links on the same joint, the one that holds it among them, cannot move
relative to it and are not checked: a gripper may well touch what it holds.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.arguments import checked, require_parts
from rrnn_opt.errors import ProblemError, RobotError
from rrnn_opt.robot.cover import cover_box, cover_capsule, cover_cylinder
from rrnn_opt.robot.fitting.solid_cover import cover_solid
from rrnn_opt.robot.robot import Robot
from rrnn_opt.robot.tree import Sphere, frozen
from rrnn_opt.scene import Box, Capsule, Cylinder, HalfSpace, Member, Mesh, Points
from rrnn_opt.scene import fields as check
from rrnn_opt.scene.reading import obstacle_from_dict

Array = NDArray[np.float64]

INFLATION = 0.005
"""Wanted inflation of the covering spheres, m."""
MOST = 200
"""Points of an attached cloud, at most: each is a sphere of the robot."""


@checked()
@dataclass(frozen=True, eq=False)
class Attached:
    """An object held by the robot.

    Attributes:
        frame: frame of the robot that it moves with.
        shape: the object, its pose in that frame.

    Raises:
        ProblemError: it is a half-space, or a cloud of too many points.
    """

    frame: str
    shape: Member

    def __post_init__(self) -> None:
        if isinstance(self.shape, HalfSpace):
            raise ProblemError("type", "a half-space has no end; attach a box")
        if isinstance(self.shape, Points) and len(self.shape.centers) > MOST:
            raise ProblemError("path", f"more than {MOST} points; attach a mesh")

    def to_dict(self) -> dict[str, Any]:
        """The object as the problem file writes it."""
        return {"frame": self.frame, **self.shape.to_dict()}


def attached_from_list(
    data: object, *, base_dir: str | Path = "."
) -> tuple[Attached, ...]:
    """The attached objects of a problem file.

    Args:
        data: ``attached`` of the file.
        base_dir: folder at which relative paths start.

    Raises:
        ProblemError: names the field, e.g. ``attached[0].frame``.
    """
    if not isinstance(data, list | tuple):
        raise ProblemError("attached", f"expected a list, got {check.shown(data)}")
    return tuple(
        _attached(d, f"attached[{i}]", Path(base_dir), i) for i, d in enumerate(data)
    )


def _attached(data: object, field: str, base: Path, index: int) -> Attached:
    if not isinstance(data, dict):
        raise ProblemError(field, f"expected an object, got {check.shown(data)}")
    if "frame" not in data:
        raise ProblemError(f"{field}.frame", "is missing")
    frame = check.text(data["frame"], f"{field}.frame")
    given = {key: value for key, value in data.items() if key != "frame"}
    given.setdefault("name", f"attached{index}")
    shape = obstacle_from_dict(given, field, f"{index}", base_dir=base)
    try:
        return Attached(frame, shape)
    except ProblemError as error:
        raise ProblemError(f"{field}.{error.field}", error.message) from None


def with_attached(robot: Robot, attached: tuple[Attached, ...]) -> Robot:
    """The robot with the attached objects as links of their own.

    Args:
        robot: the robot; objects attached to it before are taken off.
        attached: what it holds now.

    Raises:
        ProblemError: there is no such frame, or a name is taken.
    """
    bare = _without(robot)
    if not attached:
        return bare
    spheres, pairs = list(bare.spheres), list(bare.self_pairs)
    joint_of = {sphere.link: sphere.joint for sphere in spheres}
    for index, body in enumerate(attached):
        require_parts(body, f"attached[{index}]", ("frame", "shape"))
        name = body.shape.name
        if name in joint_of or name in {f.name for f in bare.frames}:
            message = f"'{name}' is already a link of the robot"
            raise ProblemError(f"attached[{index}].name", message)
        placed = _placed(bare, body, f"attached[{index}].frame")
        joint = placed[0].joint
        pairs += [(link, name) for link, other in joint_of.items() if other != joint]
        joint_of[name] = joint
        spheres += placed
    names = [body.shape.name for body in attached]
    return replace(
        bare,
        spheres=tuple(spheres),
        self_pairs=tuple(pairs),
        cover={**bare.cover, "attached": names},
    )


def _without(robot: Robot) -> Robot:
    names = set(robot.cover.get("attached", ()))
    if not names:
        return robot
    cover = {key: value for key, value in robot.cover.items() if key != "attached"}
    return replace(
        robot,
        spheres=tuple(s for s in robot.spheres if s.link not in names),
        self_pairs=tuple(p for p in robot.self_pairs if not names & set(p)),
        cover=cover,
    )


def _placed(robot: Robot, body: Attached, field: str) -> list[Sphere]:
    try:
        frame = robot.frame(body.frame)
    except RobotError as error:
        raise ProblemError(field, str(error)) from None
    rotation, origin = frame.placement[:3, :3], frame.placement[:3, 3]
    return [
        Sphere(
            body.shape.name,
            frame.joint,
            frozen(origin + rotation @ center, (3,), body.shape.name),
            radius,
        )
        for center, radius in _balls(body.shape)
    ]


def _balls(shape: Member) -> Iterator[tuple[Array, float]]:
    """Spheres that contain a shape, in the axes in which its pose is given."""
    if isinstance(shape, Points):
        for center in shape.centers:
            yield center, shape.radius
        return
    for center, radius in _local_balls(shape):
        yield shape.rotation @ center + shape.position, radius


def _local_balls(shape: Any) -> Iterator[tuple[Array, float]]:
    if isinstance(shape, Mesh):
        fitted = cover_solid(shape.vertices, shape.triangles, inflation=INFLATION)
        yield from zip(fitted.centers, fitted.radii, strict=True)
        return
    if isinstance(shape, Box):
        cover = cover_box(shape.size, inflation=INFLATION)
    elif isinstance(shape, Cylinder):
        cover = cover_cylinder(shape.radius, shape.length, inflation=INFLATION)
    elif isinstance(shape, Capsule):
        end = np.array([0.0, 0.0, 0.5 * shape.length])
        cover = cover_capsule(-end, end, radius=shape.radius, inflation=INFLATION)
    else:
        cover = None
        yield np.zeros(3), float(shape.radius)
    if cover is not None:
        for center in cover.centers:
            yield center, cover.radius
