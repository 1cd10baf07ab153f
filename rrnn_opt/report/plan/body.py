"""The robot as drawn: capsules along its links, knobs at its joints.

A plan result holds joints, a tip and collision spheres, no meshes; the links
are therefore drawn as straight capsules between consecutive joint origins, a
little slimmer than the spheres that cover them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.report.plan import mesh
from rrnn_opt.report.plan.mesh import Mesh

Array = NDArray[np.float64]

SLIM = 0.72
KNOB = 1.18
SHORT = 1e-6


@dataclass(frozen=True, eq=False)
class Part:
    """A solid fixed to a joint's frame.

    Attributes:
        joint: joint whose frame carries it, -1 for the base.
        role: "link", "joint", "tip", "base" or "sphere".
        ends: points on its axis, (k, 3), m; it is round, so it has moved as
            far as they have.
        mesh: in that frame, m.
    """

    joint: int
    role: str
    ends: Array
    mesh: Mesh

    def placed(self, frames: Array) -> Part:
        """The part in world axes, given the joint frames (nj, 4, 4)."""
        if self.joint < 0:
            return self
        pose = frames[self.joint]
        ends = self.ends @ pose[:3, :3].T + pose[:3, 3]
        return Part(self.joint, self.role, ends, self.mesh.moved(pose))


def ball(joint: int, role: str, centre: Any, radius: float, *, sides: int) -> Part:
    """A ball fixed to a joint's frame."""
    ends = np.asarray(centre, dtype=float)[None, :]
    return Part(joint, role, ends, mesh.sphere(centre, radius, sides=sides))


def parts_of(robot: dict[str, Any]) -> list[Part]:
    """Links, joint knobs, base plate and tip of a robot block."""
    radii = _radii(robot)
    parts = [_base(robot, radii)]
    for k, parent in enumerate(robot["parents"]):
        origin = np.asarray(robot["placements"][k], dtype=float)[:3, 3]
        parts += _link(parent, np.zeros(3), origin, _radius(radii, parent))
        if robot["types"][k] == "prismatic":
            if _carries_rod(robot, k):
                continue
            parts += _rod(robot, k, _radius(radii, k))
        elif parent >= 0 or origin.any():
            knob = min(KNOB * _radius(radii, k), 1.6 * _radius(radii, parent))
            parts.append(ball(k, "joint", np.zeros(3), knob, sides=18))
    tip = robot["tip"]
    end = np.asarray(tip["placement"], dtype=float)[:3, 3]
    parts += _link(tip["joint"], np.zeros(3), end, _radius(radii, tip["joint"]))
    size = 0.6 * _radius(radii, tip["joint"])
    return [*parts, ball(tip["joint"], "tip", end, size, sides=12)]


def spheres_of(robot: dict[str, Any], *, sides: int = 10) -> list[Part]:
    """The collision spheres of a robot block."""
    return [
        ball(s["joint"], "sphere", s["center"], s["radius"], sides=sides)
        for s in robot.get("spheres", [])
    ]


def span(robot: dict[str, Any]) -> float:
    """Sum of the distances between consecutive joints up to the tip, m."""
    placements = np.asarray(robot["placements"], dtype=float)
    offsets = np.linalg.norm(placements[:, :3, 3], axis=1).sum()
    tip = np.asarray(robot["tip"]["placement"], dtype=float)[:3, 3]
    return float(offsets + np.linalg.norm(tip)) or 1.0


def _radii(robot: dict[str, Any]) -> dict[int, float]:
    """Link radius by joint, from the spheres that the joint carries."""
    found: dict[int, list[float]] = {}
    for sphere in robot.get("spheres", []):
        found.setdefault(sphere["joint"], []).append(float(sphere["radius"]))
    if not found:
        return {0: 0.035 * span(robot)}
    return {joint: SLIM * float(np.median(r)) for joint, r in found.items()}


def _radius(radii: dict[int, float], joint: int) -> float:
    """The radius at a joint; without spheres that of the nearest one with some."""
    return radii[min(radii, key=lambda other: (abs(other - joint), -other))]


def _link(joint: int, a: Array, b: Array, radius: float) -> list[Part]:
    if np.linalg.norm(b - a) < SHORT:
        return []
    on_plate = joint <= 0 and not a.any()
    solid = mesh.capsule(a, b, radius, sides=20, flat=on_plate)
    return [Part(joint, "link", np.stack([a, b]), solid)]


def _carries_rod(robot: dict[str, Any], joint: int) -> bool:
    """Whether a link already lies where the rod of a prismatic joint would."""
    axis = np.asarray(robot["axes"][joint], dtype=float)
    children = [k for k, parent in enumerate(robot["parents"]) if parent == joint]
    offsets = [np.asarray(robot["placements"][k], dtype=float)[:3, 3] for k in children]
    return any(offset @ axis < -SHORT for offset in offsets)


def _rod(robot: dict[str, Any], joint: int, radius: float) -> list[Part]:
    """What slides through a prismatic joint: a rod as long as its travel."""
    limits = robot["limits"]
    source = robot["coupling"]["source"][joint]
    ends = (limits["lower"][source], limits["upper"][source])
    travel = max((abs(e) for e in ends if e is not None), default=0.0)
    axis = np.asarray(robot["axes"][joint], dtype=float)
    return _link(joint, np.zeros(3), -travel * axis, 0.5 * radius)


def _base(robot: dict[str, Any], radii: dict[int, float]) -> Part:
    """A plate at the origin of the base."""
    radius = 1.9 * _radius(radii, 0)
    plate = mesh.cylinder_z(radius, 0.0, 0.015 * span(robot), sides=40)
    return Part(-1, "base", np.zeros((1, 3)), plate)
