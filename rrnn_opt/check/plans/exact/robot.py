"""A robot and solids in ball arithmetic: every number is certain to lie in its ball.

Written apart from the double version, on purpose: kinematics joint by joint,
Jacobian columns by cross products, supports of solids by their definition.
Built from the document itself, not from what the double version made of it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import flint
import numpy as np

from rrnn_opt.check.plans.robot.model import Model
from rrnn_opt.errors import DocumentError

Ball = Any  # flint.arb: python-flint has no usable stubs
Vector = list[Ball]
PRECISION = 192
POLAR_ERROR = flint.arb(0, 2.0**-100)


def exact(x: Any) -> Ball:
    """A double as the number that it is."""
    return flint.arb(float(x))


def vector(values: Any) -> Vector:
    """Doubles as the numbers that they are."""
    return [exact(x) for x in values]


def dot(a: Sequence[Ball], b: Sequence[Ball]) -> Ball:
    """A'b."""
    return sum((x * y for x, y in zip(a, b, strict=True)), flint.arb(0))


def cross(a: Vector, b: Vector) -> Vector:
    """A vector product."""
    return [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]


def length(a: Sequence[Ball]) -> Ball:
    """|a|, a ball from zero where it may vanish."""
    square = dot(a, a)
    if square > 0:
        return square.sqrt()
    return flint.arb(0).union(square.abs_upper().sqrt())


def times(matrix: Any, v: Vector) -> Vector:
    """Matrix times vector."""
    return [dot([matrix[i, j] for j in range(3)], v) for i in range(3)]


def nearest_rotation(matrix: Any) -> Any:
    """The exact rotation nearest to one that is within 1e-9 of it, in balls."""
    x = flint.arb_mat(3, 3, [exact(a) for row in matrix for a in row[:3]])
    three = flint.arb_mat(3, 3, [3 * (i == j) for i in range(3) for j in range(3)])
    for _ in range(4):  # 1e-9, 1e-18, 1e-36, 1e-72: Newton and Schulz
        x = x * (three - x.transpose() * x) * flint.arb("0.5")
    return flint.arb_mat(3, 3, [a + POLAR_ERROR for a in x.entries()])


@dataclass(frozen=True, eq=False)
class BallPose:
    """Joint frames at one instant: rotations, origins, axes, as balls."""

    rotations: list[Any]
    origins: list[Vector]
    axes: list[Vector]


class BallRobot:
    """Forward kinematics in balls.

    Args:
        robot: the robot block of a plan.
        model: the same as read, with balls around its bodies among the spheres;
            only structure and exact doubles are taken from it.
    """

    def __init__(self, robot: Any, model: Model) -> None:
        self.model = model
        self.parents = model.parents.tolist()
        places = [np.array(p, dtype=np.float64) for p in robot["placements"]]
        self.rotations = [nearest_rotation(p[:3, :3]) for p in places]
        self.translations = [vector(p[:3, 3]) for p in places]
        self.axes = []
        for row in robot["axes"]:
            axis = vector(row)
            size = length(axis)
            self.axes.append([a / size for a in axis])
        self.centres = [vector(c) for c in model.centres]
        self.radii = vector(model.radii)

    def pose(self, joints: Vector) -> BallPose:
        """Frames at joint values."""
        rotations: list[Any] = []
        origins: list[Vector] = []
        axes: list[Vector] = []
        eye = flint.arb_mat(3, 3, [int(i == j) for i in range(3) for j in range(3)])
        for k, p in enumerate(self.parents):
            base = rotations[p] if p >= 0 else eye
            start = origins[p] if p >= 0 else [flint.arb(0)] * 3
            placed = base * self.rotations[k]
            axis = times(placed, self.axes[k])
            step = times(base, self.translations[k])
            origin = [a + b for a, b in zip(start, step, strict=True)]
            if self.model.prismatic[k]:
                origin = [a + joints[k] * b for a, b in zip(origin, axis, strict=True)]
            else:
                placed = placed * _turn(self.axes[k], joints[k])
            rotations.append(placed)
            origins.append(origin)
            axes.append(axis)
        return BallPose(rotations, origins, axes)

    def centre(self, pose: BallPose, sphere: int) -> Vector:
        """Centre of a sphere in the world."""
        joint, local = int(self.model.carrier[sphere]), self.centres[sphere]
        if joint < 0:
            return local
        turned = times(pose.rotations[joint], local)
        return [a + b for a, b in zip(pose.origins[joint], turned, strict=True)]

    def column(self, pose: BallPose, k: int, point: Vector) -> Vector:
        """Velocity of a point for a unit rate of joint k."""
        if self.model.prismatic[k]:
            return pose.axes[k]
        away = [a - b for a, b in zip(point, pose.origins[k], strict=True)]
        return cross(pose.axes[k], away)

    def reaches(self, sphere: int, low: Vector, high: Vector) -> dict[int, Ball]:
        """Chain length from each joint that moves a sphere to its centre."""
        table: dict[int, Ball] = {}
        total, k = length(self.centres[sphere]), int(self.model.carrier[sphere])
        while k >= 0:
            table[k] = total
            link = length(self.translations[k])
            if self.model.prismatic[k]:
                slide = times(self.rotations[k], self.axes[k])
                ends = (
                    length(
                        [
                            t + e * a
                            for t, a in zip(self.translations[k], slide, strict=True)
                        ]
                    )
                    for e in (low[k], high[k])
                )
                link = flint.arb.max(*ends)
            total, k = total + link, self.parents[k]
        return table


def _turn(axis: Vector, angle: Ball) -> Any:
    """Rodrigues' formula: I + sin [a]x + (1 - cos) [a]x^2."""
    x, y, z = axis
    skew = flint.arb_mat(3, 3, [0, -z, y, z, 0, -x, -y, x, 0])
    eye = flint.arb_mat(3, 3, [int(i == j) for i in range(3) for j in range(3)])
    return eye + skew * angle.sin() + skew * skew * (1 - angle.cos())


class BallSolid:
    """A convex solid, known by its support function.

    Args:
        entry: of "obstacles".

    Raises:
        DocumentError: its type has no support function here.
    """

    def __init__(self, entry: Any) -> None:
        self.kind = entry["type"]
        if self.kind not in ("box", "cylinder", "capsule", "sphere", "halfspace"):
            known = f"type '{self.kind}' cannot be judged in ball arithmetic"
            raise DocumentError("problem.obstacles", known)
        self.entry = entry
        if self.kind == "halfspace":
            return
        self.position = vector(entry["position"])
        q = vector(entry.get("quat_xyzw") or (0.0, 0.0, 0.0, 1.0))
        size = length(q)
        self.rotation = _from_quaternion([a / size for a in q])

    def gap(self, point: Vector, n: Vector) -> Ball:
        """Distance of a point beyond the half-space with normal n that holds it.

        Never more than the signed distance; n need not be of unit length.
        """
        if self.kind == "halfspace":
            n = vector(self.entry["normal"])
            return (dot(n, point) - exact(self.entry["offset"])) / length(n)
        away = [a - b for a, b in zip(point, self.position, strict=True)]
        return (dot(n, away) - self._support(n)) / length(n)

    def _support(self, n: Vector) -> Ball:
        entry, local = self.entry, times(self.rotation.transpose(), n)
        if self.kind == "box":
            return dot([abs(a) for a in local], vector(entry["size"])) / 2
        radius = exact(entry["radius"])
        if self.kind == "sphere":
            return radius * length(n)
        across = local[:2] if self.kind == "cylinder" else local
        return radius * length(across) + abs(local[2]) * exact(entry["length"]) / 2


def _from_quaternion(q: Vector) -> Any:
    """w^2 + .. form of the rotation of a unit quaternion."""
    x, y, z, w = q
    entries = [
        w * w + x * x - y * y - z * z, 2 * (x * y - z * w), 2 * (x * z + y * w),
        2 * (x * y + z * w), w * w - x * x + y * y - z * z, 2 * (y * z - x * w),
        2 * (x * z - y * w), 2 * (y * z + x * w), w * w - x * x - y * y + z * z,
    ]  # fmt: skip
    return flint.arb_mat(3, 3, entries)
