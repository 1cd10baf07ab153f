"""The form of a plan document, seen before anything of it is drawn."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from rrnn_opt.errors import DocumentError

MOST_ROWS = 1_000_000
LARGEST = 1e9
BLOCKS = ("certificate", "stats", "versions", "trees")
MOST = {"joints": 1_000, "spheres": 5_000, "obstacles": 10_000}


def require_plan(document: Any) -> None:
    """See that numbers are numbers, and rows as long as the robot has joints.

    Args:
        document: what a plan result should be.

    Raises:
        DocumentError: names the field that is not of the form of a plan result.
    """
    _mapping(document, "plan")
    for key in ("robot", "problem"):
        if not isinstance(document.get(key), dict):
            raise DocumentError("plan", f"there is no '{key}' in it to draw")
    nv = _robot(document["robot"])
    problem = document["problem"]
    _array(problem.get("start"), (nv,), "problem.start")
    _list(problem.get("obstacles") or [], "problem.obstacles", MOST["obstacles"])
    for key in BLOCKS:
        if document.get(key):
            _mapping(document[key], key)
    cell = (document.get("stats") or {}).get("memory_cell")
    if cell:
        _array(cell, (None,), "stats.memory_cell")
    if document.get("path"):
        _array(document["path"], (None, nv), "path")
    if document.get("trajectory"):
        _rows(document["trajectory"], nv)


def _robot(robot: Mapping[str, Any]) -> int:
    limits = _mapping(robot.get("limits"), "robot.limits")
    velocity = _array(limits.get("velocity"), (None,), "robot.limits.velocity")
    if not 0 < len(velocity) <= MOST["joints"] or np.any(velocity <= 0.0):
        raise DocumentError("robot.limits.velocity", "must be positive, one a joint")
    names = robot.get("joint_names")
    if names and len(_list(names, "robot.joint_names")) != len(velocity):
        raise DocumentError("robot.joint_names", f"must be {len(velocity)} names")
    _list(robot.get("spheres") or [], "robot.spheres", MOST["spheres"])
    _list(robot.get("parents"), "robot.parents", MOST["joints"])
    return len(velocity)


def _rows(trajectory: Any, nv: int) -> None:
    given = _mapping(trajectory, "trajectory")
    t = _array(given.get("t"), (None,), "trajectory.t")
    if not 2 <= len(t) <= MOST_ROWS or np.any(np.diff(t) <= 0.0):
        raise DocumentError("trajectory.t", "must increase, in two rows at least")
    for key in ("q", "qd", "qdd"):
        if key != "qdd" or key in given:
            _array(given.get(key), (len(t), nv), f"trajectory.{key}")


def _mapping(value: Any, field: str) -> Mapping[str, Any]:
    if not isinstance(value, dict):
        raise DocumentError(field, "must be an object")
    return value


def _list(value: Any, field: str, most: int = MOST_ROWS) -> list[Any]:
    if not isinstance(value, list) or len(value) > most:
        raise DocumentError(field, f"must be a list of {most} entries at most")
    return value


def _array(value: Any, shape: tuple[int | None, ...], field: str) -> Any:
    """Finite numbers of a shape (None: any length)."""
    try:
        array = np.array(value)
    except (ValueError, TypeError, OverflowError, RecursionError):
        array = np.array(None)
    fits = array.ndim == len(shape) and all(
        want is None or want == got
        for want, got in zip(shape, array.shape, strict=True)
    )
    if not fits or array.dtype.kind not in "iuf" or np.any(~(np.abs(array) <= LARGEST)):
        words = " x ".join("n" if n is None else str(n) for n in shape)
        raise DocumentError(field, f"must be {words} finite numbers")
    return array
