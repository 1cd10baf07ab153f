"""A planar arm among a ball or behind a wall, its searches and its formulas."""

import functools
import itertools

import casadi as ca
import numpy as np

import rrnn_opt as rr
from rrnn_opt.formulations import method1, method2
from rrnn_opt.planning import PaperRnn, Problem
from rrnn_opt.planning.rollout.library import (
    RolloutSearch,
    rollout_runtime_of,
)
from rrnn_opt.planning.search.request import pack

SAFE = 0.2


BALL = {"name": "ball", "type": "sphere", "radius": 0.2, "position": [1.3, 0.9, 0.0]}


SECOND = PaperRnn(safe=SAFE)


LEVELS = {"velocity": method1, "acceleration": method2}


def document(**more):
    return {
        "robot": "planar3",
        "start": [-0.3, 0.4, 0.5],
        "goal": {"position": [0.6, 1.6, 0.0], "tolerance": 0.001},
        "obstacles": [BALL],
        **more,
    }


def walled():
    """The arm upright, the goal behind a wall that nothing passes."""
    wall = {"name": "wall", "type": "box", "size": [0.1, 6.0, 1.0]}
    return document(
        start=[np.pi / 2, 0.0, 0.0],
        goal={"position": [2.0, 0.5, 0.0]},
        obstacles=[{**wall, "position": [1.2, 0.0, 0.0]}],
    )


def opened(problem, settings, seed=0):
    runtime = rollout_runtime_of(problem.robot, settings)
    packed = pack(problem, (), problem.goals, seed)
    return RolloutSearch(runtime, settings, packed.struct, packed.keep)


def states(rng, robot, count):
    """Free postures with velocities inside half of the speed limits."""
    problem = Problem.from_dict(document())
    with opened(problem, SECOND) as search:
        while count > 0:
            q = rng.uniform(0.8 * robot.limits.lower, 0.8 * robot.limits.upper)
            if search.postures_free(q)[0]:
                count -= 1
                yield q, rng.uniform(-0.5, 0.5, robot.nv) * robot.limits.velocity


def near_states(rng, robot, count):
    """States of ``states`` with a contact."""
    every = states(rng, robot, 10**6)
    return itertools.islice((s for s in every if contacts(robot, s[0])[0]), count)


def contacts(robot, q):
    """Sphere, gap and outward normal of every sphere within SAFE of the ball."""
    centre = np.array(BALL["position"])
    away = at("centres", q) - centre[:, None]
    length = np.linalg.norm(away, axis=0)
    radii = np.array([s.radius for s in robot.spheres])
    gaps = length - BALL["radius"] - radii
    near = np.flatnonzero(gaps <= SAFE)
    return near.tolist(), gaps[near], away[:, near] / length[near]


@functools.cache
def forward():
    """Tip, its Jacobian and the spheres' centres of the planar arm."""
    kin = rr.Kinematics(rr.Robot.builtin("planar3"))
    centres = kin.sphere_centres()
    return kin, {
        "tip": ca.Function("tip", [kin.q], [kin.position()]),
        "jacobian": ca.Function("jacobian", [kin.q], [kin.jacobian()]),
        "centres": ca.Function("centres", [kin.q], [centres]),
        "slopes": ca.Function("slopes", [kin.q], [ca.jacobian(ca.vec(centres), kin.q)]),
    }


def at(name, q):
    return np.array(forward()[1][name](q))


def tip(robot, q):
    return at("tip", q).ravel()
