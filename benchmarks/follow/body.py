"""Robot and scene of a plan document for pinocchio and coal."""

from __future__ import annotations

from typing import Any

import coal
import numpy as np
import pinocchio as pin


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


def shape_of(obstacle: dict[str, Any]) -> tuple[Any, Any]:
    """An obstacle of the problem as coal's shape and its place."""
    kind = obstacle["type"]
    quat = obstacle.get("quat_xyzw", [0.0, 0.0, 0.0, 1.0])
    x, y, z, w = quat
    rotation = pin.Quaternion(w, x, y, z).toRotationMatrix()
    position = np.array(obstacle.get("position", [0.0, 0.0, 0.0]), float)
    if kind == "box":
        shape = coal.Box(*(float(v) for v in obstacle["size"]))
    elif kind == "sphere":
        shape = coal.Sphere(float(obstacle["radius"]))
    elif kind == "mesh":
        corners = coal.StdVec_Vec3s()
        corners.extend(list(_vertices(obstacle)))
        shape = coal.Convex.convexHull(corners, True, "")
    elif kind == "halfspace":
        normal = np.array(obstacle["normal"], float)
        shape = coal.Halfspace(normal, float(obstacle["offset"]))
    else:
        solid = {"cylinder": coal.Cylinder, "capsule": coal.Capsule}[kind]
        shape = solid(float(obstacle["radius"]), float(obstacle["length"]))
    return shape, coal.Transform3s(rotation, position)


def _vertices(obstacle: dict[str, Any]) -> np.ndarray:
    """Corners of a mesh obstacle in its own axes, read by trimesh, (n, 3), m."""
    import trimesh  # of the extra viz; scenes without meshes do not need it

    mesh = trimesh.load(obstacle["path"], force="mesh", process=False)
    scale = np.broadcast_to(np.array(obstacle.get("scale", 1.0), float), (3,))
    return np.unique(np.array(mesh.vertices, float) * scale, axis=0)


class Follower:
    """Robot and scene of one plan document."""

    def __init__(self, document: dict[str, Any]) -> None:
        robot = document["robot"]
        self.robot, self.model = robot, model_of(robot)
        self.data = self.model.createData()
        self.joints = np.array([s["joint"] for s in robot["spheres"]], int)
        self.centers = np.array([s["center"] for s in robot["spheres"]], float)
        self.radii = np.array([s["radius"] for s in robot["spheres"]], float)
        self.source = np.array(robot["coupling"]["source"])
        self.multiplier = np.array(robot["coupling"]["multiplier"], float)
        self.offset = np.array(robot["coupling"]["offset"], float)
        self.solids = [shape_of(o) for o in document["problem"]["obstacles"]]
        self.balls = [coal.Sphere(float(r)) for r in self.radii]
        self.moving = np.flatnonzero(self.joints >= 0)
        self.used = [int(k) + 1 for k in np.unique(self.joints[self.moving])]
        self.pairs = self._self_pairs()
        self.reach = self._reach()
        self._place = coal.Transform3s(_STRAIGHT, np.zeros(3))
        self._request, self._result = coal.DistanceRequest(), coal.DistanceResult()

    def _self_pairs(self) -> np.ndarray:
        of: dict[str, list[int]] = {}
        for index, sphere in enumerate(self.robot["spheres"]):
            of.setdefault(sphere["link"], []).append(index)
        found = [
            (i, j)
            for a, b in self.robot["self_pairs"]
            for i in of.get(a, ())
            for j in of.get(b, ())
        ]
        return np.array(found, int).reshape(-1, 2)

    def _reach(self) -> np.ndarray:
        """How far each joint moves each sphere, (ns, nj): m/rad, or 1.

        Along the way from a joint to the sphere the translations are added.
        """
        robot, count = self.robot, len(self.robot["types"])
        steps = [np.linalg.norm(np.array(p)[:3, 3]) for p in robot["placements"]]
        for k, kind in enumerate(robot["types"]):
            steps[k] += self._slide(k) if kind == "prismatic" else 0.0
        found = np.zeros((len(self.radii), count))
        for i, joint in enumerate(self.joints):
            way, at = float(np.linalg.norm(self.centers[i])), int(joint)
            while at >= 0:
                slides = robot["types"][at] == "prismatic"
                way += self._slide(at) if slides else 0.0
                found[i, at] = 1.0 if slides else way
                way += float(np.linalg.norm(np.array(robot["placements"][at])[:3, 3]))
                at = int(robot["parents"][at])
        return found

    def _slide(self, joint: int) -> float:
        """Longest travel of a prismatic joint from zero, m."""
        k = int(self.source[joint])
        ends = [self.robot["limits"][key][k] for key in ("lower", "upper")]
        values = [abs(self.multiplier[joint] * e + self.offset[joint]) for e in ends]
        return float(max(values))

    def at(self, q: np.ndarray, qd: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Places and velocities of all spheres' centres at N postures.

        Args:
            q: (N, nv) coordinates, rad or m.
            qd: (N, nv) their rates.

        Returns:
            Two arrays (N, ns, 3), m and m/s.
        """
        values = q[:, self.source] * self.multiplier + self.offset
        rates = qd[:, self.source] * self.multiplier
        count = len(self.robot["types"]) + 1
        frames, twists = np.zeros((len(q), count, 4, 4)), np.zeros((len(q), count, 6))
        frames[:, 0] = np.eye(4)
        poses, moves = self.data.oMi, self.data.v
        for n in range(len(q)):
            pin.forwardKinematics(self.model, self.data, values[n], rates[n])
            for k in self.used:
                frames[n, k], twists[n, k] = poses[k].homogeneous, moves[k].vector
        on = self.joints + 1
        local = twists[:, on, :3] + np.cross(twists[:, on, 3:], self.centers)
        frames = frames[:, on]
        turned, places = frames[..., :3, :3], frames[..., :3, 3]
        where = (turned @ self.centers[:, :, None])[..., 0] + places
        return where, (turned @ local[..., None])[..., 0]

    def gap(self, sphere: int, solid: int, place: np.ndarray) -> tuple[float, Any]:
        """Distance of a sphere to a solid by coal, and the solid's nearest point."""
        shape, there = self.solids[solid]
        self._result.clear()
        self._place.setTranslation(place)
        ball = self.balls[sphere]
        d = coal.distance(ball, self._place, shape, there, self._request, self._result)
        return float(d), self._result.getNearestPoint2()

    def accelerations(self, rates: np.ndarray, changes: np.ndarray) -> np.ndarray:
        """Bound on every sphere's acceleration in each of N intervals, (N, ns), m/s2.

        With R[i, k] from ``reach``, |p''| <= sum_k R[i, k] |q_k''| +
        sum_kl R[i, the farther of k and l] |q_k'| |q_l'|.

        Args:
            rates: largest joint speeds, (N, nv), rad/s or m/s.
            changes: largest joint accelerations, (N, nv).
        """
        speed = np.abs(self.multiplier) * rates[:, self.source]
        change = np.abs(self.multiplier) * changes[:, self.source]
        order = np.arange(speed.shape[1])
        farther = np.maximum(order[:, None], order)
        both = (self.reach[:, :, None] > 0.0) & (self.reach[:, None, :] > 0.0)
        second = np.where(both, self.reach[:, farther], 0.0)
        turning = np.einsum("ikl,nk,nl->ni", second, speed, speed, optimize=True)
        return np.asarray(np.maximum(change @ self.reach.T + turning, 1e-9))


_STRAIGHT = np.eye(3)
