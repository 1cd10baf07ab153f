"""Proofs, before any search, that a problem has no solution."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.planning.problem.goals import JOINT_TOLERANCE, JointGoal, TipGoal
from rrnn_opt.planning.problem.problem import Problem
from rrnn_opt.planning.search.library import Search
from rrnn_opt.planning.search.structs import Contact
from rrnn_opt.robot.kinematics import Kinematics
from rrnn_opt.robot.reach import reach, reach_ball
from rrnn_opt.robot.robot import Robot
from rrnn_opt.robot.tree import CONTINUOUS
from rrnn_opt.scene import Mesh

Array = NDArray[np.float64]

ROUNDING = 1e-9
"""What a proof must have to spare, m: more than rounding up to 1e5 m."""
_MILLIMETRES = 20.0
"""A goal as many reaches away was hardly written in metres."""


@dataclass(frozen=True)
class Infeasible:
    """Why there is no solution, with what shows it.

    Attributes:
        message: one sentence.
        witness: the numbers behind it.
    """

    message: str
    witness: dict[str, Any] = field(default_factory=dict)


def nearest_turn(robot: Robot, q: Array, reference: Array) -> Array:
    """``q`` with continuous joints moved by whole turns nearest ``reference``."""
    result = q.copy()
    for joint, kind in enumerate(robot.tree.types):
        if kind == CONTINUOUS:
            k = int(robot.tree.source[joint])
            turns = np.round((reference[k] - q[k]) / (2 * np.pi))
            result[k] = q[k] + 2 * np.pi * turns
    return result


def describe(
    problem: Problem, contact: Contact, q: Array
) -> tuple[str, dict[str, Any]]:
    """The pair of a contact in words, and as data."""
    spheres = problem.robot.spheres
    link = spheres[contact.sphere].link
    other = (
        spheres[contact.other].link
        if contact.is_self
        else _obstacle_name(problem, contact.other)
    )
    margin = 0.0 if contact.is_self else problem.margin
    clearance = contact.gap + margin
    pair = f"link '{link}' and '{other}'"
    if clearance < 0.0:
        what = f"{pair} overlap by {-clearance:.6g} m"
    else:
        what = f"{pair} are {clearance:.6g} m apart, less than the margin {margin:g} m"
    data = {"q": q.tolist(), "link": link, "other": other, "clearance": clearance}
    return what, data


def _obstacle_name(problem: Problem, solid: int) -> str:
    """Name of the obstacle that one of the runtime's solids belongs to."""
    owner = problem.solids.solids.owner[solid]
    return problem.scene.obstacles[int(owner)].name


def blocked(
    problem: Problem, search: Search, q: Array, name: str, *, within: float = 0.0
) -> Infeasible | None:
    """Proof that a posture's closest pair is nearer than allowed, or None.

    The gap of a hull is a lower bound outside of it: there the distance to one of
    the hull's points, which is an upper bound, takes its place.

    Args:
        problem: robot and scene.
        search: opened on the problem.
        q: the posture, (nv,), rad or m.
        name: what it is called in the message.
        within: the proof is for all postures so near in every coordinate, rad or m.
    """
    contact = search.closest(q)
    if contact is None or contact.gap >= -ROUNDING:
        return None
    if not contact.is_self:
        gap = max(contact.gap, _largest_gap(problem, contact, q))
        contact = replace(contact, gap=gap)
    if contact.gap + _sway(problem.robot, contact, within) >= -ROUNDING:
        return None
    what, data = describe(problem, contact, q)
    verb = "is in collision" if data["clearance"] < 0.0 else "is too close"
    return Infeasible(f"{name} {verb}: {what}", data)


def _sway(robot: Robot, contact: Contact, within: float) -> float:
    """How far a pair can part while every coordinate changes by so much, m."""
    levers = within * np.abs(robot.tree.multiplier) @ reach(robot)
    pair = [contact.sphere, contact.other] if contact.is_self else [contact.sphere]
    return float(levers[pair].sum())


def _largest_gap(problem: Problem, contact: Contact, q: Array) -> float:
    """What the gap to a hull is at most, m; -inf where the gap is no lower bound."""
    owner = int(problem.solids.solids.owner[contact.other])
    obstacle = problem.scene.obstacles[owner]
    reserved = problem.robot.spheres[contact.sphere].radius + problem.margin
    if not isinstance(obstacle, Mesh) or contact.gap + reserved <= 0.0:
        return -np.inf
    centres = Kinematics(problem.robot).functions()["sphere_centres"](q)
    centre = np.array(centres)[:, contact.sphere]
    return _to_hull(centre, obstacle.corners()) - reserved


def _to_hull(point: Array, corners: Array) -> float:
    """Distance from a point to the nearest convex combination of corners, m.

    min |V'w| over w >= 0 with sum w = 1, V = corners - point, as non-negative least
    squares with the sum weighted by V's size: scaling w to the sum 1 leaves its
    direction, which is that of the optimum.
    """
    from scipy.optimize import nnls  # costs more to import than a plan

    arms = corners - point
    size = float(np.abs(arms).max())
    rows = np.vstack([arms.T / size, np.ones(len(arms))])
    weights = nnls(rows, np.array([0.0, 0.0, 0.0, 1.0]))[0]
    return float(np.linalg.norm(weights @ arms) / weights.sum())


def out_of_reach(problem: Problem, goal: TipGoal) -> Infeasible | None:
    """Proof that a tip goal lies beyond the sum of the link lengths."""
    centre, radius = reach_ball(problem.robot, problem.frame)
    distance = goal.distance(centre)
    if distance <= radius + goal.tolerance + ROUNDING:
        return None
    units = "; positions are metres" if distance > _MILLIMETRES * radius else ""
    return Infeasible(
        f"goal is beyond reach: {distance:.6g} m from the first joint, while the arm"
        f" reaches {radius:.6g} m{units}",
        {"distance": distance, "reach": radius, "center": centre.tolist()},
    )


@dataclass(frozen=True)
class OpenGoals:
    """Goals that no proof has closed."""

    joints: tuple[Array, ...]
    tips: tuple[TipGoal, ...]

    def nearest(self, start: Array) -> float:
        """No path to a goal is shorter, rad or m; 0 where goals of the tip are open."""
        if self.tips or not self.joints:
            return 0.0
        return min(float(np.linalg.norm(q - start)) for q in self.joints)


def open_goals(problem: Problem, search: Search) -> OpenGoals | Infeasible:
    """Goals worth a search, or the proof that none is left."""
    joints: list[Array] = []
    tips: list[TipGoal] = []
    closed: list[Infeasible] = []
    for goal in problem.goals:
        if isinstance(goal, JointGoal):
            q = nearest_turn(problem.robot, np.asarray(goal.joints), problem.start)
            verdict = blocked(problem, search, q, "goal", within=JOINT_TOLERANCE)
            if verdict is None:
                joints.append(q)
        else:
            verdict = out_of_reach(problem, goal)
            if verdict is None:
                tips.append(goal)
        if verdict is not None:
            closed.append(verdict)
    if not joints and not tips:
        return closed[0]
    return OpenGoals(tuple(joints), tuple(tips))
