"""Obstacles from the problem file's form; the way back is ``Scene.to_dict``."""

from __future__ import annotations

from typing import get_args

from rrnn_opt.errors import ProblemError
from rrnn_opt.scene import fields
from rrnn_opt.scene.scene import KINDS, Scene
from rrnn_opt.scene.shapes import Obstacle

LATER = ("mesh", "points")
"""Types of the problem file that this version does not read."""

_CLASSES = {shape.kind: shape for shape in get_args(Obstacle)}
_REQUIRED = {
    "box": ("size", "position"),
    "cylinder": ("radius", "length", "position"),
    "capsule": ("radius", "length", "position"),
    "sphere": ("radius", "position"),
    "halfspace": ("normal", "offset"),
}
_OPTIONAL = {kind: ("quat_xyzw",) for kind in ("box", "cylinder", "capsule")}


def scene_from_list(data: object, field: str = "obstacles") -> Scene:
    """The scene of a list of obstacles.

    Args:
        data: obstacles in the problem file's form.  An obstacle without a name
            is called by its type and place, e.g. "box3"; one without
            ``quat_xyzw`` is not rotated.
        field: name of the list, for messages.

    Returns:
        The scene.

    Raises:
        ProblemError: names the field, e.g. ``obstacles[2].size[0]``.
    """
    if not isinstance(data, list | tuple):
        raise ProblemError(field, f"expected a list, got {fields.shown(data)}")
    return Scene(tuple(_obstacle(o, f"{field}[{i}]", i) for i, o in enumerate(data)))


def _obstacle(data: object, field: str, index: int) -> Obstacle:
    if not isinstance(data, dict):
        raise ProblemError(field, f"expected an object, got {fields.shown(data)}")
    kind = _kind(data.get("type"), f"{field}.type")
    given = fields.record(
        data,
        field,
        required=("type", *_REQUIRED[kind]),
        optional=("name", *_OPTIONAL.get(kind, ())),
    )
    del given["type"]
    given.setdefault("name", f"{kind}{index}")
    try:
        shape: Obstacle = _CLASSES[kind](**given)
    except ProblemError as error:
        raise ProblemError(f"{field}.{error.field}", error.message) from None
    return shape


def _kind(value: object, field: str) -> str:
    if value is None:
        raise ProblemError(field, f"is missing; known: {', '.join(KINDS)}")
    kind = fields.text(value, field)
    if kind in LATER:
        message = f"this version does not support '{kind}' obstacles, only "
        raise ProblemError(field, message + ", ".join(KINDS))
    if kind not in KINDS:
        message = f"unknown obstacle {fields.shown(kind)}; "
        raise ProblemError(field, message + fields.suggestion(kind, KINDS))
    return kind
