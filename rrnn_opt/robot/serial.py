"""A robot as plain data for JSON, and back.

The form is the ``robot`` block of a plan result: everything that an
independent checker needs, and no name of ours.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from rrnn_opt.errors import RobotError, ShapeError
from rrnn_opt.robot.data import RobotData
from rrnn_opt.robot.tree import (
    JOINT_TYPES,
    Array,
    Frame,
    Index,
    JointTree,
    Limits,
    Sphere,
    frozen,
    indices,
)


def _numbers_or_null(values: Array) -> list[float | None]:
    return [float(v) if np.isfinite(v) else None for v in values]


def robot_to_dict(robot: RobotData) -> dict[str, Any]:
    """The robot as JSON-ready data; infinite limits become null.

    Args:
        robot: the robot.

    Returns:
        name, parents, placements, axes, types, coupling, joint_names, tip,
        spheres, self_pairs and limits; SI units, matrices nested by rows.
    """
    tree, tip, limits = robot.tree, robot.frame(), robot.limits
    return {
        "name": robot.name,
        "parents": tree.parents.tolist(),
        "placements": tree.placements.tolist(),
        "axes": tree.axes.tolist(),
        "types": list(tree.types),
        "coupling": {
            "source": tree.source.tolist(),
            "multiplier": tree.multiplier.tolist(),
            "offset": tree.offset.tolist(),
        },
        "joint_names": list(robot.joint_names),
        "tip": {
            "name": tip.name,
            "joint": tip.joint,
            "placement": tip.placement.tolist(),
        },
        "spheres": [
            {
                "link": s.link,
                "joint": s.joint,
                "center": s.center.tolist(),
                "radius": s.radius,
            }
            for s in robot.spheres
        ],
        "self_pairs": [list(pair) for pair in robot.self_pairs],
        "limits": {
            "lower": _numbers_or_null(limits.lower),
            "upper": _numbers_or_null(limits.upper),
            "velocity": limits.velocity.tolist(),
            "acceleration": limits.acceleration.tolist(),
        },
    }


def robot_from_dict(data: Mapping[str, Any]) -> RobotData:
    """The robot of such data; it knows no frame but its tip.

    Args:
        data: as from ``robot_to_dict``.

    Returns:
        The robot.

    Raises:
        RobotError: an entry is missing or makes no sense.
        NotFiniteError: a number is not finite.
    """
    if not isinstance(data, Mapping):
        raise RobotError("robot", f"is no mapping but a {type(data).__name__}")
    name = data.get("name", "robot")
    if not isinstance(name, str):
        raise RobotError("robot", "'name' is no text")
    try:
        return _robot(name, data)
    except KeyError as error:
        raise RobotError(name, f"the entry {error} is missing") from None
    except RecursionError:
        raise RobotError(name, "is nested too deeply") from None
    except (TypeError, ValueError, OverflowError, ShapeError) as error:
        raise RobotError(name, f"cannot be read from data: {error}") from None


def _robot(name: str, data: Mapping[str, Any]) -> RobotData:
    names = tuple(str(joint) for joint in data["joint_names"])
    tree = _tree(data, len(names))
    tip = data["tip"]
    frame = Frame(
        str(tip["name"]),
        _carrier(tip["joint"], tree.nj),
        frozen(tip["placement"], (4, 4), "tip.placement"),
    )
    return RobotData(
        name=name,
        joint_names=names,
        tree=tree,
        limits=_limits(data["limits"], len(names)),
        frames=(frame,),
        tip=frame.name,
        spheres=tuple(_sphere(entry, tree.nj) for entry in data["spheres"]),
        self_pairs=tuple((str(a), str(b)) for a, b in data["self_pairs"]),
        source="read from data",
    )


def _carrier(joint: Any, nj: int) -> int:
    if not -1 <= int(joint) < nj:
        raise ValueError(f"there is no joint {joint}")
    return int(joint)


def _integers(
    values: Any, n: int, name: str, fits: Callable[[int, int], bool]
) -> Index:
    array = indices(values)
    if array.shape != (n,):
        raise ShapeError(name, (n,), array.shape)
    if not all(fits(k, int(value)) for k, value in enumerate(array)):
        raise ValueError(f"{name} has an index out of range")
    return array


def _tree(data: Mapping[str, Any], nv: int) -> JointTree:
    types = tuple(str(kind) for kind in data["types"])
    unknown = set(types) - set(JOINT_TYPES)
    if unknown:
        raise ValueError(f"unknown joint type '{min(unknown)}'")
    n, coupling = len(types), data["coupling"]
    tree = JointTree(
        parents=_integers(data["parents"], n, "parents", lambda k, v: -1 <= v < k),
        types=types,
        placements=frozen(data["placements"], (n, 4, 4), "placements"),
        axes=frozen(data["axes"], (n, 3), "axes"),
        source=_integers(coupling["source"], n, "source", lambda k, v: 0 <= v < nv),
        multiplier=frozen(coupling["multiplier"], (n,), "multiplier"),
        offset=frozen(coupling["offset"], (n,), "offset"),
    )
    if not np.allclose(np.linalg.norm(tree.axes, axis=1), 1.0, atol=1e-9):
        raise ValueError("axes must have unit length")
    return tree


def _limits(data: Mapping[str, Any], nv: int) -> Limits:
    lower = [-np.inf if value is None else value for value in data["lower"]]
    upper = [np.inf if value is None else value for value in data["upper"]]
    return Limits(
        frozen(lower, (nv,), "limits.lower"),
        frozen(upper, (nv,), "limits.upper"),
        frozen(data["velocity"], (nv,), "limits.velocity"),
        frozen(data["acceleration"], (nv,), "limits.acceleration"),
    )


def _sphere(entry: Mapping[str, Any], nj: int) -> Sphere:
    center = frozen(entry["center"], (3,), "sphere.center")
    joint, radius = _carrier(entry["joint"], nj), float(entry["radius"])
    return Sphere(str(entry["link"]), joint, center, radius)
