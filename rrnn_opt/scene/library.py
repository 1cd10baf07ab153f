"""The scenarios that ship with the package, as plain problem documents."""

from __future__ import annotations

import json
from dataclasses import dataclass
from importlib import resources
from typing import Any

from rrnn_opt.errors import ProblemError
from rrnn_opt.scene import fields

SCENARIOS = ("plane", "window", "window_040", "window_050", "raven_opening")
"""Shipped scenarios; a window's number is its width in centimetres, and
``window`` itself has 30.  ``raven_opening`` is a box with an opening of 4 cm."""


@dataclass(frozen=True)
class Scenario:
    """A robot, a target and obstacles, with the starts to try.

    Source: after the two scenarios of section IV-B (tables III and IV) and the
    Raven II experiment of Li, Li and Hannaford 2019, doi
    10.1109/TII.2018.2869588.  The paper prints no
    dimensions; ``choices`` says which numbers are this project's own.

    Attributes:
        name: one of ``SCENARIOS``.
        description: one line.
        choices: where the numbers come from.
        robot: name of a built-in robot.
        target: position that the robot's tip shall reach, m.
        tolerance: m.
        obstacles: in the problem file's form.
        starts: joint values to start from, rad or m.
        window: opening as {"x", "y": [low, high], "z": [low, high]}, m, or None.
    """

    name: str
    description: str
    choices: str
    robot: str
    target: tuple[float, ...]
    tolerance: float
    obstacles: tuple[dict[str, Any], ...]
    starts: tuple[tuple[float, ...], ...]
    window: dict[str, Any] | None = None

    def problem(self, start: int = 0) -> dict[str, Any]:
        """The problem that begins at one of the starts.

        Args:
            start: index into ``starts``.

        Returns:
            A new document in the problem file's form.

        Raises:
            ProblemError: there is no such start.
        """
        if not 0 <= start < len(self.starts):
            message = f"{self.name} has starts 0 to {len(self.starts) - 1}, not {start}"
            raise ProblemError("start", message)
        return {
            "name": f"{self.name} {start}",
            "robot": self.robot,
            "start": list(self.starts[start]),
            "goal": {"position": list(self.target), "tolerance": self.tolerance},
            "obstacles": [_copied(obstacle) for obstacle in self.obstacles],
            "margin": 0.0,
        }


def scenario(name: str) -> Scenario:
    """A shipped scenario.

    Args:
        name: one of ``SCENARIOS``.

    Returns:
        The scenario.

    Raises:
        ProblemError: no scenario has that name.
    """
    if name not in SCENARIOS:
        message = f"no scenario is called {fields.shown(name)}; "
        raise ProblemError("scenario", message + fields.suggestion(name, SCENARIOS))
    file = resources.files("rrnn_opt.scene") / "data" / f"{name}.json"
    data = json.loads(file.read_text(encoding="utf-8"))
    data["target"] = tuple(data["target"])
    data["obstacles"] = tuple(data["obstacles"])
    data["starts"] = tuple(tuple(start) for start in data["starts"])
    return Scenario(**data)


def _copied(obstacle: dict[str, Any]) -> dict[str, Any]:
    return {k: list(v) if isinstance(v, list) else v for k, v in obstacle.items()}
