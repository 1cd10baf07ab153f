"""Motions with an obstacle where the arm, but not the tip, would go."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import casadi as ca
import numpy as np

from rrnn_opt.scene import Scene, Sphere
from rrnn_opt.simulation import Curve, SimulationResult, Task, simulate
from rrnn_opt.simulation.task import Array
from rrnn_opt.validation.tables.arm import arm
from rrnn_opt.validation.tables.models import Model
from rrnn_opt.validation.tables.tracking import CIRCLES, task

RADIUS = 0.04
"""Of the obstacle, a ball, m."""

ROOM = 0.12
"""Clearance of every moving sphere at the start, at least, m."""

ASIDE = 0.15
"""Distance of the tip's way from the ball, at least, m."""

_TRIES = 200


@dataclass(frozen=True, eq=False)
class Blocked:
    """A motion with an obstacle in the arm's way.

    Attributes:
        task: the motion, with its scene.
        ball: the obstacle.
        contacts: spheres that the scheme is told of.
    """

    task: Task
    ball: Sphere
    contacts: tuple[int, ...]


@lru_cache(maxsize=64)
def blocked(model: Model, count: int) -> tuple[Blocked, ...]:
    """Motions in which the scheme without contacts hits the ball.

    The ball is put where a sphere of the forearm or upper arm is at the end of
    a motion of the same scheme without obstacles.

    Args:
        model: the row.
        count: how many.
    """
    robot, _ = arm()
    inner = [k for k, s in enumerate(robot.spheres) if s.joint in (2, 4)]
    rng = np.random.default_rng(7)
    found: list[Blocked] = []
    for _ in range(_TRIES):
        if len(found) == count:
            break
        free = _free(model, rng)
        sphere = int(rng.choice(inner))
        what = _with_ball(free, sphere)
        if what is not None:
            moving = [k for k, s in enumerate(robot.spheres) if s.joint >= 0]
            contacts = tuple(sorted({sphere, *moving[::4]}))
            found.append(Blocked(*what, contacts))
    return tuple(found)


def _free(model: Model, rng: np.random.Generator) -> SimulationResult:
    """A line of 0.3 m from a start near that of a circle, without obstacles."""
    robot, _ = arm()
    start, _ = list(CIRCLES.values())[int(rng.integers(len(CIRCLES)))]
    way = rng.standard_normal(3) * np.array([1.0, 1.0, 0.5])
    way[0] = -abs(way[0])
    curve = Curve("line", 5.0, 5.0, offset=0.3 * way / np.linalg.norm(way))
    q0 = np.deg2rad(np.array(start)) + 0.2 * rng.standard_normal(robot.nv)
    what = replace(task("A", 0.0, 0, law=model.law), curve=curve, q0=q0)
    return simulate(model.scheme, robot, what, network=model.network)


def _with_ball(free: SimulationResult, sphere: int) -> tuple[Task, Sphere] | None:
    """The motion with a ball at the sphere's last place; None if that is no test."""
    centres = _centres(free.q[[0, -1]])
    ball = Sphere("ball", RADIUS, centres[1][:, sphere])
    radii = np.array([s.radius for s in free.robot.spheres])
    moving = np.array([s.joint >= 0 for s in free.robot.spheres])
    away = np.linalg.norm(centres[0] - ball.position[:, None], axis=0)
    roomy = (away - radii - RADIUS)[moving].min() > ROOM
    aside = np.linalg.norm(free.tip - ball.position, axis=1).min() > ASIDE
    still = free.max_error_m < 0.05
    if not (roomy and aside and still):
        return None
    return replace(free.task, scene=Scene((ball,))), ball


def least(model: Model, case: Blocked) -> tuple[float, SimulationResult]:
    """Least clearance of the spheres that the scheme is told of, m; and the run."""
    scheme, what = model.told(case.contacts), replace(case.task)
    result = simulate(scheme, arm()[0], what, network=model.network)
    ball = case.ball
    radii = [arm()[0].spheres[k].radius for k in case.contacts]
    gaps = [
        np.linalg.norm(c[:, case.contacts] - ball.position[:, None], axis=0)
        - radii
        - RADIUS
        for c in _centres(result.q[::5])
    ]
    return float(np.min(gaps)), result


def _centres(q: Array) -> list[Array]:
    """Centres of all spheres at some postures, (3, ns) each, m."""
    function = _centre_function()
    return [np.asarray(function(row), dtype=np.float64) for row in q]


@lru_cache(maxsize=1)
def _centre_function() -> ca.Function:
    _, kin = arm()
    return ca.Function("centres", [kin.q], [kin.sphere_centres()])
