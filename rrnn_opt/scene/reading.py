"""Obstacles from the problem file's form; the way back is ``Scene.to_dict``."""

from __future__ import annotations

from pathlib import Path
from typing import Any, get_args

from rrnn_opt.errors import ProblemError
from rrnn_opt.scene import fields
from rrnn_opt.scene.scene import Member, Scene

_CLASSES: dict[str, Any] = {shape.kind: shape for shape in get_args(Member)}
_REQUIRED = {
    "box": ("size", "position"),
    "cylinder": ("radius", "length", "position"),
    "capsule": ("radius", "length", "position"),
    "sphere": ("radius", "position"),
    "halfspace": ("normal", "offset"),
    "mesh": ("path",),
    "points": ("path", "radius"),
}
_OPTIONAL = {
    **{kind: ("quat_xyzw",) for kind in ("box", "cylinder", "capsule")},
    "mesh": ("scale", "position", "quat_xyzw", "sha256"),
    "points": ("sha256",),
}


def scene_from_list(
    data: object, field: str = "obstacles", *, base_dir: str | Path = "."
) -> Scene:
    """The scene of a list of obstacles.

    Args:
        data: obstacles in the problem file's form.  An obstacle without a name
            is called by its type and place, e.g. "box3"; one without
            ``quat_xyzw`` is not rotated.
        field: name of the list, for messages.
        base_dir: folder at which relative paths of meshes and points start.

    Returns:
        The scene.

    Raises:
        ProblemError: names the field, e.g. ``obstacles[2].size[0]``.
    """
    if not isinstance(data, list | tuple):
        raise ProblemError(field, f"expected a list, got {fields.shown(data)}")
    base = Path(base_dir)
    return Scene(
        tuple(
            obstacle_from_dict(o, f"{field}[{i}]", f"{i}", base_dir=base)
            for i, o in enumerate(data)
        )
    )


def obstacle_from_dict(
    data: object, field: str, suffix: str, *, base_dir: Path
) -> Member:
    """One obstacle.

    Args:
        data: the obstacle in the problem file's form.
        field: its name, for messages.
        suffix: makes a name of the type where none is given.
        base_dir: folder at which relative paths start.

    Raises:
        ProblemError: names the field.
    """
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
    given.setdefault("name", f"{kind}{suffix}")
    if "path" in given:
        path = fields.text(given["path"], f"{field}.path")
        given["path"] = str((base_dir / path).absolute())
    try:
        shape: Member = _CLASSES[kind](**given)
    except ProblemError as error:
        raise ProblemError(f"{field}.{error.field}", error.message) from None
    return shape


def _kind(value: object, field: str) -> str:
    if value is None:
        raise ProblemError(field, f"is missing; known: {', '.join(_CLASSES)}")
    kind = fields.text(value, field)
    if kind not in _CLASSES:
        message = f"unknown obstacle {fields.shown(kind)}; "
        raise ProblemError(field, message + fields.suggestion(kind, _CLASSES))
    return kind
