"""The robot of a problem file: by name, or by path with what goes with it."""

from __future__ import annotations

from pathlib import Path

from rrnn_opt.errors import ProblemError
from rrnn_opt.robot.builtin import BUILTIN
from rrnn_opt.robot.robot import Robot
from rrnn_opt.scene import fields


def named_robot(
    ref: str, base: Path, texts: dict[str, str], locked: dict[str, float]
) -> Robot:
    """The robot that ``robot`` names: built in, or a URDF below ``base``.

    Args:
        ref: name or path.
        base: folder at which relative paths start.
        texts: ``frame`` and ``spheres``, where the file has them.
        locked: values of joints that do not move, rad or m.

    Raises:
        ProblemError: there is none, or a field does not go with it.
        RobotError: its own files cannot be used.
    """
    if ref in BUILTIN:
        for key, given in (("spheres", "spheres" in texts), ("locked", bool(locked))):
            if given:
                message = f"is for robots from a URDF, and '{ref}' is built in"
                raise ProblemError(key, message)
        return Robot.builtin(ref)
    if not ref.lower().endswith((".urdf", ".xml")) and "/" not in ref:
        message = f"no robot is called {fields.shown(ref)}"
        hint = fields.suggestion(ref, BUILTIN)
        raise ProblemError(
            "robot", f"{message}; {hint}; or give a path of a .urdf file"
        )
    spheres = _file(base, texts["spheres"], "spheres") if "spheres" in texts else None
    urdf = _file(base, ref, "robot")
    tip = texts.get("frame")
    return Robot.from_urdf(urdf, tip=tip, spheres=spheres, locked=locked)


def _file(base: Path, ref: str, field: str) -> Path:
    path = base / ref
    try:
        found = path.is_file()
    except (OSError, ValueError):  # a name that no file can have
        found = False
    if not found:
        raise ProblemError(field, f"there is no file {fields.shown(str(path), 200)}")
    return path


def locked_joints(data: object) -> dict[str, float]:
    """Values of joints that do not move, rad or m, by name.

    Raises:
        ProblemError: not numbers by name.
    """
    if not isinstance(data, dict):
        message = f"expected an object, got {fields.shown(data)}"
        raise ProblemError("locked", message)
    return {
        fields.text(joint, "locked"): fields.number(value, fields.join("locked", joint))
        for joint, value in data.items()
    }
