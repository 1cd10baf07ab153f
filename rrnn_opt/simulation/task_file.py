"""Reader of TASK.toml: every field is checked, and named when it is wrong."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from rrnn_opt.errors import DocumentError, ProblemError
from rrnn_opt.files import read_text
from rrnn_opt.scene.fields import not_negative, positive, record, text, vector
from rrnn_opt.scene.reading import scene_from_list
from rrnn_opt.simulation.task_parts import (
    ENTRANCES,
    KINDS,
    LAWS,
    PLANES,
    PROFILES,
    Control,
    Curve,
    Noise,
)

THROUGH_START = "start"
MOST_STEPS = 10_000_000
"""Largest number of control steps of one run: its record has to fit in memory."""


def read_toml(path: str | Path) -> dict[str, Any]:
    """The document of a TOML file.

    Raises:
        DocumentError: the file cannot be read or is no TOML.
    """
    text = read_text(path)
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise DocumentError(str(path), "nested too deeply") from None
    except ValueError as error:  # no TOML, or a number of thousands of digits
        raise DocumentError(str(path), f"is not TOML: {error}") from error


def task_fields(document: Mapping[str, Any]) -> dict[str, Any]:
    """The fields of the task that a document describes, by name.

    Raises:
        ProblemError: a field is missing, unknown or wrong; it is named.
    """
    parts = record(
        document, "", required=("task", "robot"), optional=("control", "noise", "scene")
    )
    robot = record(parts["robot"], "robot", required=("q0",), optional=("frame",))
    q0 = robot["q0"]
    length = len(q0) if isinstance(q0, list | tuple) else 1
    curve, q0 = _curve(parts["task"]), vector(q0, length, "robot.q0")
    frame = text(robot["frame"], "robot.frame") if "frame" in robot else None
    control, noise = _control(parts.get("control", {})), _noise(parts.get("noise", {}))
    fields = {"curve": curve, "q0": q0, "frame": frame, "control": control}
    fields |= {"noise": noise, **_scene(parts.get("scene", {}))}
    if not 1 <= round(curve.duration / control.dt) <= MOST_STEPS:
        message = f"must make 1 to {MOST_STEPS} control steps of control.dt"
        raise ProblemError("task.duration", message)
    return fields


_FIELDS = {
    "circle": (("radius",), ("plane", "centre", "through")),
    "figure8": (("radius",), ("plane", "centre", "through")),
    "line": ((), ("offset", "position")),
    "point": ((), ("offset", "position")),
}


def _curve(value: Any) -> Curve:
    kind = _choice(value, "task", "kind", KINDS, None)
    required, optional = _FIELDS[kind]
    common = ("period", "profile", "duration")
    entry = record(
        value, "task", required=("kind", *required), optional=(*optional, *common)
    )
    period = positive(entry.get("period", 10.0), "task.period")
    curve = Curve(
        kind=kind,
        period=period,
        duration=positive(entry.get("duration", period), "task.duration"),
        profile=_choice(entry, "task", "profile", PROFILES, "smooth"),
    )
    if kind in ("line", "point"):
        return _straight(curve, entry)
    return _closed(curve, entry)


def _closed(curve: Curve, entry: Mapping[str, Any]) -> Curve:
    if "centre" in entry and "through" in entry:
        raise ProblemError("task.through", "give either centre or through, not both")
    if "through" in entry:
        _choice(entry, "task", "through", (THROUGH_START,), None)
    centre = vector(entry["centre"], 3, "task.centre") if "centre" in entry else None
    return replace(
        curve,
        plane=_choice(entry, "task", "plane", tuple(PLANES), "yz"),
        radius=positive(entry["radius"], "task.radius"),
        centre=centre,
    )


def _straight(curve: Curve, entry: Mapping[str, Any]) -> Curve:
    if ("offset" in entry) == ("position" in entry):
        raise ProblemError("task.offset", "give exactly one of offset and position")
    key = "offset" if "offset" in entry else "position"
    where = vector(entry[key], 3, f"task.{key}")
    if key == "offset":
        return replace(curve, offset=where)
    return replace(curve, position=where)


def _control(value: Any) -> Control:
    names = ("dt", "epsilon", "kappa", "law", "steps")
    entry = record(value, "control", required=(), optional=names)
    default = Control()
    return Control(
        dt=positive(entry.get("dt", default.dt), "control.dt"),
        epsilon=positive(entry.get("epsilon", default.epsilon), "control.epsilon"),
        kappa=not_negative(entry.get("kappa", default.kappa), "control.kappa"),
        law=_choice(entry, "control", "law", LAWS, default.law),
        steps=_whole(entry["steps"], "control.steps", 1) if "steps" in entry else None,
    )


def _noise(value: Any) -> Noise:
    entry = record(value, "noise", required=(), optional=("enters", "sigma", "seed"))
    return Noise(
        enters=_choice(entry, "noise", "enters", ENTRANCES, ENTRANCES[0]),
        sigma=not_negative(entry.get("sigma", 0.0), "noise.sigma"),
        seed=_whole(entry.get("seed", 0), "noise.seed", 0),
    )


def _scene(value: Any) -> dict[str, Any]:
    entry = record(value, "scene", required=(), optional=("obstacles", "contacts"))
    scene = scene_from_list(entry.get("obstacles", []), "scene.obstacles")
    given = entry.get("contacts")
    if given is None:
        return {"scene": scene, "contacts": None}
    if not isinstance(given, list | tuple):
        raise ProblemError("scene.contacts", "expected a list of sphere indices")
    found = (_whole(k, f"scene.contacts[{i}]", 0) for i, k in enumerate(given))
    return {"scene": scene, "contacts": tuple(found)}


def _whole(value: Any, name: str, least: int) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or value < least:
        raise ProblemError(name, f"expected a whole number of at least {least}")
    return value


def _choice(
    entry: Any, table: str, key: str, known: tuple[str, ...], default: str | None
) -> str:
    """One of the known words; required when there is no default."""
    name = f"{table}.{key}"
    if not isinstance(entry, Mapping):
        raise ProblemError(table, "expected a table")
    if key not in entry:
        if default is None:
            raise ProblemError(name, f"is missing; known: {', '.join(known)}")
        return default
    if entry[key] not in known:
        raise ProblemError(name, f"is not known; known: {', '.join(known)}")
    return str(entry[key])
