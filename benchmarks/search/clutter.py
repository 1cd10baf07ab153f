"""Cages and thin shelves for the Panda, drawn at random: position goals inside."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

Obstacle = dict[str, Any]
READY = (0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785)
BAR, PLATE = 0.015, 0.01
"""Radius of a bar and thickness of a plate, m."""


def _turned(point: np.ndarray, angle: float, centre: np.ndarray) -> list[float]:
    c, s = np.cos(angle), np.sin(angle)
    x, y, z = point
    return [centre[0] + c * x - s * y, centre[1] + s * x + c * y, centre[2] + z]


def _turn(angle: float) -> list[float]:
    return [0.0, 0.0, float(np.sin(angle / 2)), float(np.cos(angle / 2))]


def cage(rng: np.random.Generator) -> dict[str, Any]:
    """A floor, upright bars on all four sides, rails on top; the goal inside."""
    centre = np.array([rng.uniform(0.45, 0.6), rng.uniform(-0.25, 0.25), 0.05])
    angle, half, height = rng.uniform(-0.6, 0.6), 0.2, rng.uniform(0.3, 0.45)
    size = [2 * half, 2 * half, 0.02]
    floor = {"type": "box", "size": size, "position": centre.tolist()}
    parts: list[Obstacle] = [floor | {"quat_xyzw": _turn(angle)}]
    for side in range(4):
        for offset in (-half, -half / 3, half / 3):
            at = np.array([[offset, -half], [half, offset], [-offset, half]])
            x, y = (*at, [-half, -offset])[side]
            place = _turned(np.array([x, y, height / 2]), angle, centre)
            bar = {"type": "cylinder", "radius": BAR, "length": height}
            parts.append(bar | {"position": place})
    goal = centre + np.array([0.0, 0.0, rng.uniform(0.1, 0.2)])
    return _problem("cage", parts, goal)


def shelf(rng: np.random.Generator) -> dict[str, Any]:
    """Thin plates 0.28 to 0.34 m apart between two side walls; a goal between."""
    centre = np.array([rng.uniform(0.65, 0.75), rng.uniform(-0.2, 0.2), 0.0])
    angle, gap = rng.uniform(-0.4, 0.4), rng.uniform(0.28, 0.34)
    parts: list[Obstacle] = []
    for level in range(4):
        place = _turned(np.array([0.0, 0.0, 0.1 + level * gap]), angle, centre)
        plate = {"type": "box", "size": [0.35, 0.9, PLATE], "position": place}
        parts.append(plate | {"quat_xyzw": _turn(angle)})
    for side in (-0.45, 0.45):
        place = _turned(np.array([0.0, side, 0.1 + 1.5 * gap]), angle, centre)
        wall = {"type": "box", "size": [0.35, PLATE, 3 * gap], "position": place}
        parts.append(wall | {"quat_xyzw": _turn(angle)})
    level = int(rng.integers(0, 3))
    inside = np.array([-0.08, rng.uniform(-0.25, 0.25), 0.1 + (level + 0.5) * gap])
    return _problem("shelf", parts, np.array(_turned(inside, angle, centre)))


def _problem(name: str, parts: list[Obstacle], goal: np.ndarray) -> dict[str, Any]:
    return {
        "name": name,
        "robot": "panda",
        "start": list(READY),
        "goal": {"position": goal.tolist(), "tolerance": 1e-3},
        "obstacles": [{"name": f"{name} {i}", **part} for i, part in enumerate(parts)],
    }


def scenes(kind: str, count: int, seed: int = 0) -> Iterator[dict[str, Any]]:
    """Problems of one kind, "cage" or "shelf", as problem documents."""
    make = {"cage": cage, "shelf": shelf}[kind]
    rng = np.random.default_rng([seed, len(kind)])
    for _ in range(count):
        yield make(rng)
