"""Follow a delivered trajectory by conservative advancement on coal's distances.

A second opinion on ``check``: kinematics by pinocchio, distances by coal.  At
time t a pair of a sphere and a convex solid (or of two spheres) has the gap g
along the normal n, and g changes at the rate c = n.v.  While no sphere speeds
up by more than A, the gap is at least

    g + c s - A s^2 / 2   at time t + s,

for the solid stays behind the plane through its nearest point.  Time moves on
until the first of these bounds is used up, and pairs near their end are asked
again: no collision fits in between.  Below ``FLOOR_S`` time moves on by that
much all the same, and the count of such steps is told.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import coal
import numpy as np
import pinocchio as pin

FLOOR_S = 1e-3
AHEAD_S = 4e-3
"""Pairs that could meet within this time are asked whenever any is."""
SLACK = 1e-7
"""Taken off every gap, m: normals are those of rounded nearest points."""


@dataclass(frozen=True)
class Followed:
    """What was met on the way.

    Attributes:
        least: smallest gap found, m; negative in a collision.
        queries: postures at which pairs were asked.
        floored: steps that were longer than the gap allowed.
        outside: largest amount by which a position left its limits, or by which
            velocity or acceleration exceeded theirs (as a share of the limit).
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
    elif kind == "halfspace":
        normal = np.array(obstacle["normal"], float)
        shape = coal.Halfspace(normal, float(obstacle["offset"]))
    else:
        solid = {"cylinder": coal.Cylinder, "capsule": coal.Capsule}[kind]
        shape = solid(float(obstacle["radius"]), float(obstacle["length"]))
    return shape, coal.Transform3s(rotation, position)


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
        self.pairs = self._self_pairs()
        self.reach = self._reach()
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
        """Places and velocities of all spheres' centres, (ns, 3), m and m/s."""
        values = self.multiplier * q[self.source] + self.offset
        rates = self.multiplier * qd[self.source]
        pin.forwardKinematics(self.model, self.data, values, rates)
        turns = np.array([pose.rotation for pose in self.data.oMi])[self.joints + 1]
        places = np.array([pose.translation for pose in self.data.oMi])
        twists = np.array([twist.vector for twist in self.data.v])[self.joints + 1]
        c, w = self.centers.T, twists[:, 3:].T
        turned = [
            w[1] * c[2] - w[2] * c[1],
            w[2] * c[0] - w[0] * c[2],
            w[0] * c[1] - w[1] * c[0],
        ]
        local = twists[:, :3].T + np.array(turned)
        where = np.einsum("sij,sj->si", turns, self.centers) + places[self.joints + 1]
        return where, np.einsum("sij,js->si", turns, local)

    def gap(self, sphere: int, solid: int, place: np.ndarray) -> tuple[float, Any]:
        """Distance of a sphere to a solid by coal, and the solid's nearest point."""
        shape, there = self.solids[solid]
        at = coal.Transform3s(_STRAIGHT, place)
        self._result.clear()
        ball = self.balls[sphere]
        d = coal.distance(ball, at, shape, there, self._request, self._result)
        return float(d), self._result.getNearestPoint2()

    def accelerations(self, rates: np.ndarray, changes: np.ndarray) -> np.ndarray:
        """Bound on every sphere's acceleration, (ns,), m/s2.

        With R[i, k] from ``reach``, |p''| <= sum_k R[i, k] |q_k''| +
        sum_kl R[i, the farther of k and l] |q_k'| |q_l'|.

        Args:
            rates: largest joint speeds, (nv,), rad/s or m/s.
            changes: largest joint accelerations, (nv,).
        """
        speed = np.abs(self.multiplier) * rates[self.source]
        change = np.abs(self.multiplier) * changes[self.source]
        order = np.arange(len(speed))
        farther = np.maximum(order[:, None], order)
        both = (self.reach[:, :, None] > 0.0) & (self.reach[:, None, :] > 0.0)
        second = np.where(both, self.reach[:, farther], 0.0)
        found = self.reach @ change + np.einsum("ikl,k,l->i", second, speed, speed)
        return np.maximum(found, 1e-9)


_STRAIGHT = np.eye(3)


class _Pairs:
    """When the bound of every pair is used up, and the least gap found."""

    def __init__(self, follower: Follower, most: np.ndarray) -> None:
        self.follower = follower
        count = len(follower.solids)
        self.first = np.concatenate(
            [np.repeat(follower.moving, count), follower.pairs[:, 0]]
        )
        self.second = np.concatenate(
            [np.tile(np.arange(count), len(follower.moving)), follower.pairs[:, 1]]
        )
        self.alone = len(follower.moving) * count
        self.most = most[self.first]
        self.most[self.alone :] += most[follower.pairs[:, 1]]
        self.until = np.zeros(len(self.first))
        self.least, self.asked = np.inf, 0

    def ask(self, now: float, q: np.ndarray, qd: np.ndarray) -> float:
        """Ask the pairs near their end; the time to which all bounds hold."""
        follower, (where, speed) = self.follower, self.follower.at(q, qd)
        due = np.flatnonzero(self.until < now + AHEAD_S)
        one, other = self.first[due], self.second[due]
        away, gaps = np.zeros((len(due), 3)), np.zeros(len(due))
        single = due < self.alone
        for k in np.flatnonzero(single):
            place = where[one[k]]
            gaps[k], nearest = follower.gap(int(one[k]), int(other[k]), place)
            away[k] = place - nearest
        rate, (i, j) = speed[one], (one[~single], other[~single])
        away[~single] = where[i] - where[j]
        rate[~single] -= speed[j]
        apart = np.maximum(np.sqrt(np.einsum("pk,pk->p", away, away)), 1e-12)
        gaps[~single] = apart[~single] - follower.radii[i] - follower.radii[j]
        opens = np.einsum("pk,pk->p", away, rate) / apart
        a, room = self.most[due], np.maximum(gaps - SLACK, 0.0)
        self.until[due] = now + (opens + np.sqrt(opens * opens + 2 * a * room)) / a
        self.least = min(self.least, float(np.min(gaps, initial=np.inf)))
        self.asked += 1
        return float(np.min(self.until, initial=np.inf))


def follow(document: dict[str, Any]) -> Followed:
    """Walk the delivered trajectory of a plan document."""
    t, q, qd = (np.array(document["trajectory"][k], float) for k in ("t", "q", "qd"))
    follower = Follower(document)
    h = np.diff(t)[:, None]
    mean, a, b = np.diff(q, axis=0) / h, qd[:-1], qd[1:]
    changes = np.abs([6 * mean - 4 * a - 2 * b, 2 * a + 4 * b - 6 * mean]) / h
    rates = [joint_speeds(q[r : r + 2], qd[r : r + 2], h[r, 0]) for r in range(len(h))]
    most = follower.accelerations(np.max(rates, axis=0), changes.max(axis=(0, 1)))
    pairs, now, floored = _Pairs(follower, most), float(t[0]), 0
    while now < t[-1]:
        until = pairs.ask(now, *posture(t, q, qd, now))
        floored += until - now < FLOOR_S and until < t[-1]
        now = min(max(until, now + FLOOR_S), float(t[-1]))
    pairs.ask(now, q[-1], qd[-1])
    outside = beyond_limits(document["robot"]["limits"], t, q, qd)
    return Followed(pairs.least, pairs.asked, int(floored), outside)


def sampled(document: dict[str, Any], step_rad: float = 1e-3) -> float:
    """Least gap at samples at most ``step_rad`` of any joint apart, m.

    A pair is asked again when its sphere has moved by as much as its gap was.
    """
    t, q, qd = (np.array(document["trajectory"][k], float) for k in ("t", "q", "qd"))
    follower, least = Follower(document), np.inf
    count = (len(follower.radii), len(follower.solids))
    gaps, asked = np.zeros(count), np.zeros((*count, 3))
    i, j = follower.pairs.T
    for row in range(len(t) - 1):
        h = t[row + 1] - t[row]
        speed = float(np.max(joint_speeds(q[row : row + 2], qd[row : row + 2], h)))
        for s in np.linspace(0.0, h, 2 + int(speed * h / step_rad)):
            where, _ = follower.at(*posture(t, q, qd, t[row] + s))
            apart = np.linalg.norm(where[i] - where[j], axis=1)
            room = apart - follower.radii[i] - follower.radii[j]
            least = min(least, float(np.min(room, initial=np.inf)))
            moved = np.linalg.norm(where[:, None] - asked, axis=2)
            stale = (moved >= gaps) & (follower.joints >= 0)[:, None]
            for sphere, solid in np.argwhere(stale):
                gap, _ = follower.gap(int(sphere), int(solid), where[sphere])
                gaps[sphere, solid], asked[sphere, solid] = gap, where[sphere]
                least = min(least, gap)
    return least


def posture(
    t: np.ndarray, q: np.ndarray, qd: np.ndarray, now: float
) -> tuple[np.ndarray, np.ndarray]:
    """Positions and velocities of the delivered cubic at one time."""
    i = min(max(int(np.searchsorted(t, now, side="right")) - 1, 0), len(t) - 2)
    h = t[i + 1] - t[i]
    x = (now - t[i]) / h
    a, b, mean = qd[i], qd[i + 1], (q[i + 1] - q[i]) / h
    second, third = 3 * mean - 2 * a - b, a + b - 2 * mean
    place = q[i] + h * x * (a + x * (second + x * third))
    return place, a + x * (2 * second + 3 * x * third)


def beyond_limits(
    limits: dict[str, Any], t: np.ndarray, q: np.ndarray, qd: np.ndarray
) -> float:
    """Largest excess over the limits between the rows; see ``Followed``."""
    bounds = {
        key: np.array([np.nan if v is None else v for v in limits[key]], float)
        for key in ("lower", "upper", "velocity", "acceleration")
    }
    h = np.diff(t)[:, None]
    mean = np.diff(q, axis=0) / h
    second, third = 3 * mean - 2 * qd[:-1] - qd[1:], qd[:-1] + qd[1:] - 2 * mean
    fine = np.linspace(0.0, 1.0, 9)[:, None, None]
    place = q[:-1] + h * fine * (qd[:-1] + fine * (second + fine * third))
    speed = qd[:-1] + fine * (2 * second + 3 * fine * third)
    rate = np.stack([2 * second, 2 * second + 6 * third]) / h
    off = [
        np.fmax(bounds["lower"] - place, place - bounds["upper"]),
        np.abs(speed) / bounds["velocity"] - 1.0,
        np.abs(rate) / bounds["acceleration"] - 1.0,
    ]
    return max(0.0, *(float(np.nanmax(part, initial=0.0)) for part in off))


def ends_error(document: dict[str, Any]) -> tuple[float, float]:
    """Distance of the first posture from the start, and of the last from a goal.

    The second is a share of the goal's tolerance (of 1e-6 rad for joint goals);
    the nearest goal counts.
    """
    problem, robot = document["problem"], document["robot"]
    first, last = (np.array(document["trajectory"]["q"][k], float) for k in (0, -1))
    goals = problem["goal"] if isinstance(problem["goal"], list) else [problem["goal"]]
    begin = float(np.max(np.abs(first - np.array(problem["start"]))))
    follower = Follower(document)
    follower.at(last, 0.0 * last)
    tip = robot["tip"]
    place = np.array(tip["placement"], float)
    pose = follower.data.oMi[int(tip["joint"]) + 1] * pin.SE3(
        place[:3, :3], place[:3, 3]
    )
    return begin, min(_missed(goal, last, pose, robot) for goal in goals)


def _missed(
    goal: dict[str, Any], q: np.ndarray, pose: pin.SE3, robot: dict[str, Any]
) -> float:
    if "joints" in goal:
        off = q - np.array(goal["joints"], float)
        turning = [v is None for v in robot["limits"]["lower"]]
        off[turning] -= 2 * np.pi * np.round(off[turning] / (2 * np.pi))
        return float(np.max(np.abs(off))) / 1e-6
    way = float(np.linalg.norm(pose.translation - np.array(goal["position"], float)))
    missed = way / float(goal["tolerance"])
    if goal.get("quat_xyzw"):
        x, y, z, w = goal["quat_xyzw"]
        wanted = pin.Quaternion(w, x, y, z).toRotationMatrix()
        turn = float(np.linalg.norm(pin.log3(wanted.T @ pose.rotation)))
        missed = max(missed, turn / float(goal["angle_tolerance"]))
    return missed


def joint_speeds(q: np.ndarray, qd: np.ndarray, h: float) -> np.ndarray:
    """Largest speed of each coordinate between two rows: Bezier ordinates."""
    middle = 1.5 * (q[1] - q[0]) / h - 0.25 * (qd[0] + qd[1])
    inner = 2.0 * middle - 0.5 * (qd[0] + qd[1])
    return np.max(np.abs([qd[0], inner, qd[1]]), axis=0)
