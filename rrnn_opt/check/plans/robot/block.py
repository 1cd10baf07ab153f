"""The robot block of a document, read into a model or refused by its field."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.check.plans import reading
from rrnn_opt.check.plans.reading import Array, get
from rrnn_opt.check.plans.robot.model import Model
from rrnn_opt.errors import DocumentError

TYPES = ("revolute", "continuous", "prismatic")


def read_model(robot: Any) -> Model:
    """The robot block of a plan.

    Raises:
        DocumentError: a field is missing or malformed.
    """
    block = reading.mapping(robot, "robot")
    names = reading.listing(get(block, "joint_names", "robot"), "robot.joint_names")
    if not names:
        raise DocumentError("robot.joint_names", "at least one joint must move")
    tree = _tree(block, len(names))
    nj = len(tree["parents"])
    return Model(
        **tree,
        **_limits(get(block, "limits", "robot"), len(names)),
        **_spheres(block, nj),
        tip=_tip(get(block, "tip", "robot"), nj),
    )


def _tree(block: Mapping[str, Any], nv: int) -> dict[str, Any]:
    types = reading.listing(get(block, "types", "robot"), "robot.types")
    nj = len(types)
    if any(kind not in TYPES for kind in types):
        raise DocumentError("robot.types", f"must be of {', '.join(TYPES)}")
    parents = reading.indices(
        get(block, "parents", "robot"), nj, -1, nj, "robot.parents"
    )
    if np.any(parents >= np.arange(nj)):
        raise DocumentError("robot.parents", "parents must come first")
    coupling = reading.mapping(get(block, "coupling", "robot"), "robot.coupling")
    source = reading.indices(
        get(coupling, "source", "robot.coupling"), nj, 0, nv, "robot.coupling.source"
    )
    rotation, translation = _placements(get(block, "placements", "robot"), nj)
    continuous = np.zeros(nv, dtype=bool)
    continuous[source[[kind == "continuous" for kind in types]]] = True
    return {
        "parents": parents,
        "rotation": rotation,
        "translation": translation,
        "axes": _axes(get(block, "axes", "robot"), nj),
        "prismatic": np.array([kind == "prismatic" for kind in types], dtype=bool),
        "continuous": continuous,
        "source": source,
        "multiplier": _coupled(coupling, "multiplier", nj),
        "offset": _coupled(coupling, "offset", nj),
        "moved_by": _moved_by(parents),
    }


def _coupled(coupling: Mapping[str, Any], key: str, nj: int) -> Array:
    name = f"robot.coupling.{key}"
    return reading.numbers(get(coupling, key, "robot.coupling"), (nj,), name)


def _placements(value: Any, nj: int) -> tuple[Array, Array]:
    name = "robot.placements"
    matrices = reading.numbers(value if nj else np.zeros((0, 4, 4)), (nj, 4, 4), name)
    if np.any(matrices[:, 3] != (0.0, 0.0, 0.0, 1.0)):
        raise DocumentError(name, "last rows must be 0 0 0 1")
    rotation = reading.rotation(matrices[:, :3, :3], name)
    return reading.polished(rotation), matrices[:, :3, 3]


def _axes(value: Any, nj: int) -> Array:
    axes = reading.numbers(value, (nj, 3), "robot.axes")
    if np.any(np.abs(np.linalg.norm(axes, axis=1) - 1.0) > 1e-9):
        raise DocumentError("robot.axes", "must be of unit length")
    unit: Array = axes / np.sqrt(np.sum(axes * axes, axis=1))[:, None]
    return unit


def _moved_by(parents: NDArray[np.int64]) -> NDArray[np.bool_]:
    nj = len(parents)
    table = np.zeros((nj, nj), dtype=bool)
    for i, parent in enumerate(parents):
        if parent >= 0:
            table[i] = table[parent]
        table[i, i] = True
    return table


def _limits(value: Any, nv: int) -> dict[str, Any]:
    limits = reading.mapping(value, "robot.limits")
    result: dict[str, Any] = {}
    for key, missing in (("lower", -np.inf), ("upper", np.inf)):
        name = f"robot.limits.{key}"
        row = reading.listing(get(limits, key, "robot.limits"), name)
        given = np.array([x is not None for x in row], dtype=bool)
        if len(row) != nv:
            raise DocumentError(name, f"must be {nv} numbers")
        result[key] = np.full(nv, missing)
        kept = [x for x in row if x is not None]
        result[key][given] = reading.numbers(kept, (len(kept),), name)
    for key in ("velocity", "acceleration"):
        name = f"robot.limits.{key}"
        result[key] = reading.numbers(get(limits, key, "robot.limits"), (nv,), name)
        if np.any(result[key] <= 0):
            raise DocumentError(name, "must be positive")
    return result


def _spheres(block: Mapping[str, Any], nj: int) -> dict[str, Any]:
    entries = reading.listing(get(block, "spheres", "robot"), "robot.spheres")
    if not entries:
        raise DocumentError("robot.spheres", "needs a sphere: nothing is no body")
    items = [reading.mapping(e, f"robot.spheres[{i}]") for i, e in enumerate(entries)]
    fields = {
        key: [get(e, key, f"robot.spheres[{i}]") for i, e in enumerate(items)]
        for key in ("link", "joint", "center", "radius")
    }
    ns = len(items)
    links = tuple(reading.text(x, "robot.spheres.link") for x in fields["link"])
    centres = fields["center"] or np.zeros((0, 3))
    radii = reading.numbers(fields["radius"], (ns,), "robot.spheres.radius")
    if np.any(radii < 0):
        raise DocumentError("robot.spheres.radius", "must not be negative")
    return {
        "links": links,
        "carrier": reading.indices(fields["joint"], ns, -1, nj, "robot.spheres.joint"),
        "centres": reading.numbers(centres, (ns, 3), "robot.spheres.center"),
        "radii": radii,
        "pairs": _pairs(get(block, "self_pairs", "robot"), links),
    }


def _pairs(value: Any, links: tuple[str, ...]) -> NDArray[np.int64]:
    rows = []
    for k, entry in enumerate(reading.listing(value, "robot.self_pairs")):
        name = f"robot.self_pairs[{k}]"
        pair = [reading.text(x, name) for x in reading.listing(entry, name)]
        if len(pair) != 2:
            raise DocumentError(name, "must be two bodies")
        for body in pair:
            if body not in links:
                raise DocumentError(name, f"no sphere of the robot is of '{body}'")
        first = [i for i, link in enumerate(links) if link == pair[0]]
        second = [i for i, link in enumerate(links) if link == pair[1]]
        rows += [(i, j) for i in first for j in second]
    return np.array(rows, dtype=np.int64).reshape(-1, 2)


def _tip(value: Any, nj: int) -> tuple[str, int, Array, Array]:
    tip = reading.mapping(value, "robot.tip")
    joint = reading.indices(
        [get(tip, "joint", "robot.tip")], 1, -1, nj, "robot.tip.joint"
    )
    rotation, translation = reading.pose(
        get(tip, "placement", "robot.tip"), "robot.tip.placement"
    )
    name = reading.text(get(tip, "name", "robot.tip"), "robot.tip.name")
    return name, int(joint[0]), rotation, translation
