"""Follow a delivered trajectory by conservative advancement on coal's distances.

A second opinion on ``check``: kinematics by pinocchio, distances by coal.  From
each instant time moves on by ``least gap / largest closing speed``, which no
collision can fit into; below ``FLOOR_S`` it moves on by that much all the same,
and the count of such steps is told.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import coal
import numpy as np
import pinocchio as pin

FLOOR_S = 1e-3


@dataclass(frozen=True)
class Followed:
    """What was met on the way.

    Attributes:
        least: smallest gap found, m; negative in a collision.
        queries: postures at which all pairs were asked.
        floored: steps that were longer than the gap allowed.
        outside: largest amount by which a joint left its limits, rad or m.
    """

    least: float
    queries: int
    floored: int
    outside: float


def model_of(robot: dict[str, Any]) -> pin.Model:
    """The robot block of a plan as a pinocchio model; joint k+1 is joint k."""
    model = pin.Model()
    for k, kind in enumerate(robot["types"]):
        axis = np.array(robot["axes"][k], float)
        unaligned = {
            "prismatic": pin.JointModelPrismaticUnaligned,
        }.get(kind, pin.JointModelRevoluteUnaligned)
        place = np.array(robot["placements"][k], float)
        parent = int(robot["parents"][k]) + 1
        pose = pin.SE3(place[:3, :3], place[:3, 3])
        model.addJoint(parent, unaligned(axis), pose, f"j{k}")
    return model


def shape_of(obstacle: dict[str, Any]) -> coal.CollisionObject:
    """An obstacle of the problem as a coal object."""
    kind = obstacle["type"]
    quat = obstacle.get("quat_xyzw", [0.0, 0.0, 0.0, 1.0])
    x, y, z, w = quat
    rotation = pin.Quaternion(w, x, y, z).toRotationMatrix()
    position = np.array(obstacle.get("position", [0.0, 0.0, 0.0]), float)
    if kind == "box":
        shape = coal.Box(*(float(v) for v in obstacle["size"]))
    elif kind == "sphere":
        shape = coal.Sphere(float(obstacle["radius"]))
    elif kind == "halfspace":
        normal = np.array(obstacle["normal"], float)
        shape = coal.Halfspace(normal, float(obstacle["offset"]))
    else:
        solid = {"cylinder": coal.Cylinder, "capsule": coal.Capsule}[kind]
        shape = solid(float(obstacle["radius"]), float(obstacle["length"]))
    return coal.CollisionObject(shape, coal.Transform3s(rotation, position))


class Follower:
    """Robot and scene of one plan document."""

    def __init__(self, document: dict[str, Any]) -> None:
        robot = document["robot"]
        self.model = model_of(robot)
        self.data = self.model.createData()
        self.joints = np.array([s["joint"] for s in robot["spheres"]])
        self.centers = np.array([s["center"] for s in robot["spheres"]], float)
        self.radii = np.array([s["radius"] for s in robot["spheres"]], float)
        self.robot = robot
        self.source = np.array(robot["coupling"]["source"])
        self.obstacles = [shape_of(o) for o in document["problem"]["obstacles"]]
        self.balls = [coal.Sphere(float(r)) for r in self.radii]
        self.pairs = self._self_pairs()
        self.reach = self._reach()

    def _self_pairs(self) -> np.ndarray:
        links = [s["link"] for s in self.robot["spheres"]]
        wanted = {frozenset(p) for p in self.robot["self_pairs"]}
        found = [
            (i, j)
            for i in range(len(links))
            for j in range(i)
            if frozenset((links[i], links[j])) in wanted
        ]
        return np.array(found, int).reshape(-1, 2)

    def _reach(self) -> np.ndarray:
        """Per joint: translations of all later joints and the farthest sphere."""
        steps = [np.linalg.norm(np.array(p)[:3, 3]) for p in self.robot["placements"]]
        ends = zip(*(self.robot["limits"][k] for k in ("lower", "upper")), strict=True)
        slides = [max(abs(low or 0.0), abs(high or 0.0)) for low, high in ends]
        source = self.robot["coupling"]["source"]
        for k, kind in enumerate(self.robot["types"]):
            steps[k] += slides[source[k]] if kind == "prismatic" else 0.0
        later = np.cumsum(steps[::-1])[::-1] - np.array(steps)
        arms = later + np.linalg.norm(self.centers, axis=1).max()
        arms[np.array(self.robot["types"]) == "prismatic"] = 1.0
        return np.array(arms * np.abs(self.robot["coupling"]["multiplier"]))

    def values(self, q: np.ndarray) -> np.ndarray:
        """Joint values of coordinates."""
        coupling = self.robot["coupling"]
        return np.array(coupling["multiplier"]) * q[coupling["source"]] + np.array(
            coupling["offset"]
        )

    def gaps(self, q: np.ndarray) -> tuple[float, float]:
        """Least gap to the obstacles and of the self pairs, m."""
        pin.forwardKinematics(self.model, self.data, self.values(q))
        poses = [self.data.oMi[int(j) + 1] for j in self.joints]
        placed = zip(poses, self.centers, strict=True)
        where = np.array([pose.act(center) for pose, center in placed])
        least = itself = np.inf
        request, result = coal.DistanceRequest(), coal.DistanceResult()
        for joint, ball, place in zip(self.joints, self.balls, where, strict=True):
            if joint < 0:
                continue
            at = coal.Transform3s(np.eye(3), place)
            for obstacle in self.obstacles:
                result.clear()
                shape = obstacle.collisionGeometry()
                there = obstacle.getTransform()
                d = coal.distance(ball, at, shape, there, request, result)
                least = min(least, d)
        if len(self.pairs):
            i, j = self.pairs.T
            apart = np.linalg.norm(where[i] - where[j], axis=1)
            itself = float(np.min(apart - self.radii[i] - self.radii[j]))
        return float(least), itself


def follow(document: dict[str, Any]) -> Followed:
    """Walk the delivered trajectory of a plan document."""
    follower = Follower(document)
    t, q, qd = (np.array(document["trajectory"][k], float) for k in ("t", "q", "qd"))
    lower, upper = (
        np.array([np.nan if v is None else v for v in document["robot"]["limits"][k]])
        for k in ("lower", "upper")
    )
    least, outside, queries, floored = np.inf, 0.0, 0, 0
    for row in range(len(t) - 1):
        h = t[row + 1] - t[row]
        rates = joint_speeds(q[row : row + 2], qd[row : row + 2], h)
        speed = float(follower.reach @ rates[follower.source])
        s = 0.0
        while s < h:
            now = hermite(q[row : row + 2], qd[row : row + 2], h, s / h)
            to_scene, to_itself = follower.gaps(now)
            least, queries = min(least, to_scene, to_itself), queries + 1
            off = np.fmax(lower - now, now - upper)
            outside = max(outside, float(np.nanmax(off, initial=0.0)))
            gap = min(to_scene, to_itself / 2)  # both of a self pair move
            step = max(gap, 0.0) / max(speed, 1e-12)
            floored += step < FLOOR_S
            s += max(step, FLOOR_S)
    return Followed(least, queries, int(floored), outside)


def hermite(q: np.ndarray, qd: np.ndarray, h: float, x: float) -> np.ndarray:
    """The cubic between two rows at the share x of their time."""
    a, b = 2 * x**3 - 3 * x**2 + 1, x**3 - 2 * x**2 + x
    c, d = -2 * x**3 + 3 * x**2, x**3 - x**2
    return a * q[0] + b * h * qd[0] + c * q[1] + d * h * qd[1]


def joint_speeds(q: np.ndarray, qd: np.ndarray, h: float) -> np.ndarray:
    """Largest speed of each coordinate between two rows: Bezier ordinates."""
    middle = 1.5 * (q[1] - q[0]) / h - 0.25 * (qd[0] + qd[1])
    inner = 2.0 * middle - 0.5 * (qd[0] + qd[1])
    return np.max(np.abs([qd[0], inner, qd[1]]), axis=0)
