"""Proof that a rigid part of the tool must be in an obstacle wherever a goal is met.

A sphere on the tip's own joint has a fixed offset o from the tip.  Where the goal
is met its centre lies within ``spread`` of the convex hull of some *spots*:

    goal               spots                        spread - tolerance
    position           corners of the region        |o|
    pose               these, moved by R o          |o| c
    pose, free axis a  these, moved by R a (a'o)    |a'o| c + |o - a (a'o)|

with R the goal's axes and c = 2 sin(angle tolerance / 2).  The signed distance
from a convex solid is convex and changes no faster than its point moves; so it is
nowhere there more than its largest value at the spots, plus ``spread``.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.planning.problem.goals import AXES, TipGoal
from rrnn_opt.planning.problem.problem import Problem
from rrnn_opt.planning.search.feasibility import Infeasible
from rrnn_opt.robot.tree import BASE, Sphere
from rrnn_opt.scene.distance import distance_function
from rrnn_opt.scene.records import HULL, SOLIDS, Records

Array = NDArray[np.float64]
SLACK = 1e-8
"""What a proof must have to spare, m: far more than rounding."""


def tool_blocked(problem: Problem, goal: TipGoal) -> Infeasible | None:
    """Proof that no posture meets the goal and keeps the tool out of obstacles.

    Args:
        problem: robot and scene.
        goal: of the tip.

    Returns:
        The sphere's link and the obstacle, or None where there is no such proof.
    """
    tip = problem.robot.frame(problem.frame)
    for sphere in problem.robot.spheres:
        if sphere.joint == tip.joint != BASE:
            turn, origin = tip.placement[:3, :3], tip.placement[:3, 3]
            spots, spread = _places(goal, turn.T @ (sphere.center - origin))
            hit = _swallowed(problem, spots, spread, sphere)
            if hit is not None:
                return hit
    return None


def _places(goal: TipGoal, offset: Array) -> tuple[Array, float]:
    """Spots (n, 3) and spread, m, of a point with this offset from the tip."""
    signs = np.array(np.meshgrid(*[(-1.0, 1.0)] * 3)).reshape(3, -1).T
    corners = goal.position + (signs * goal.half_edges) @ goal.rotation.T
    if goal.quat_xyzw is None:
        return corners, goal.tolerance + float(np.linalg.norm(offset))
    kept = offset
    if goal.free_axis is not None:
        kept = offset * (np.array(AXES) == goal.free_axis)
    chord = 2.0 * np.sin(min(goal.angle_tolerance, np.pi) / 2.0)
    sway = float(np.linalg.norm(kept) * chord + np.linalg.norm(offset - kept))
    return corners + goal.rotation @ kept, goal.tolerance + sway


def _swallowed(
    problem: Problem, spots: Array, spread: float, sphere: Sphere
) -> Infeasible | None:
    """The solid that the sphere must be too near to, whatever its centre."""
    solids, least = problem.solids.solids, sphere.radius + problem.margin
    low, high = solids.bounds[:, :3] - least, solids.bounds[:, 3:] + least
    around = np.all((low <= spots.min(axis=0)) & (spots.max(axis=0) <= high), axis=1)
    for kind in np.unique(solids.kind[around]):
        chosen = np.flatnonzero(around & (solids.kind == kind))
        most = _largest(solids, SOLIDS[kind], chosen, spots) + spread
        worst = int(np.argmin(most))
        # from outside a hull's planes say too little
        sure = SOLIDS[kind] != HULL or most[worst] <= 0.0
        if sure and most[worst] < least - SLACK:
            other = problem.scene.obstacles[int(solids.owner[chosen[worst]])].name
            clearance = float(most[worst]) - sphere.radius
            return _infeasible(problem, sphere.link, other, clearance)
    return None


def _largest(
    solids: Records, kind: str, chosen: NDArray[np.intp], spots: Array
) -> Array:
    """Largest signed distance of the spots from each solid of a kind, m.

    Of a hull it is the largest from the planes of its facets.
    """
    first = solids.first[chosen]
    if kind != HULL:
        points = np.tile(spots, (len(chosen), 1)).T
        rows = np.repeat(solids.rows[first], len(spots), axis=0).T
        apart = np.array(distance_function(kind)(points, rows)[0])
        return np.asarray(apart.reshape(len(chosen), -1).max(axis=1))
    hulls = [solids.rows[k + 1 : k + 1 + int(solids.rows[k, 12])] for k in first]
    return np.array([np.max(spots @ h[:, 6:9].T - h[:, 12]) for h in hulls])


def _infeasible(
    problem: Problem, link: str, other: str, clearance: float
) -> Infeasible:
    what = f"goal cannot be met: link '{link}', which carries the tip, would"
    if clearance < 0.0:
        what += f" overlap '{other}' by {-clearance:.6g} m or more"
    else:
        what += f" be at most {clearance:.6g} m from '{other}', less than the margin"
        what += f" {problem.margin:g} m"
    return Infeasible(what, {"link": link, "other": other, "clearance": clearance})
