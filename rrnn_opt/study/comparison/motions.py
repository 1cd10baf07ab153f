"""QPs of redundancy resolution, recorded in closed loop on arms that move.

Each control period the scheme's QP is built at the arm's own posture, solved (by
DAQP, cold), and its joint velocity is done for ``PERIOD_S``: so consecutive QPs
differ as those of a real controller do.  Where a QP has no solution the arm stands
still for that period.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from rrnn_opt.formulations import clearance_rows, minimum_velocity
from rrnn_opt.solving import DaqpSession, Instance, find_farkas
from rrnn_opt.solving.parts import Array
from rrnn_opt.study.comparison.arms import (
    ARMS,
    SAFE_M,
    Arm,
    arm,
    contacts,
    obstacle_scheme,
    velocity_scheme,
)
from rrnn_opt.study.comparison.problem_set import (
    INFEASIBLE,
    SOLVABLE,
    UNKNOWN,
    ProblemSet,
)

PERIOD_S = 0.02
COUNT = 60
NEAR = 0.01
"""Least singular value of the translational Jacobian that "singular" starts at."""


GAIN = 5.0
"""Of the feedback on the tip's position, 1/s."""


def motion_set(kind: str, name: str) -> ProblemSet:
    """The QPs of one kind of motion on one arm.

    Args:
        kind: of ``MOTIONS``.
        name: of ``ARMS``.
    """
    made = MOTIONS[kind](arm(name))
    about = f"{made.about} ({name}, {len(made.instances)} periods of 20 ms)"
    scheme = partial(_SCHEMES[made.scheme], name)
    named = f"{kind}/{name}"
    return ProblemSet(named, made.instances, made.truth, True, about, scheme)


@dataclass(frozen=True, eq=False)
class Recorded:
    """What a loop leaves: QPs, their truth, what it was, name of its scheme."""

    instances: tuple[Instance, ...]
    truth: tuple[str, ...]
    about: str
    scheme: str = "velocity"


Reference = Callable[[float], Array]
"""Share of the motion, 0 to 1 -> displacement of the tip from its start, m."""


_SCHEMES = {"velocity": velocity_scheme, "obstacles": obstacle_scheme}


def track(made: Arm, path: Reference, about: str) -> Recorded:
    """Follow a curve with ``minimum_velocity`` and feedback.

    Args:
        made: the arm.
        path: displacement of the tip.
        about: for the reader.
    """
    form, tip = minimum_velocity(made.kin), made.tip
    q, home = made.start.copy(), np.asarray(tip(made.start)).ravel()
    instances = []
    for k in range(COUNT):
        here, then = (home + path((k + i) / COUNT) for i in (0, 1))
        error = here - np.asarray(tip(q)).ravel()
        given = {"q": q.copy(), "rd_dot": (then - here) / PERIOD_S + GAIN * error}
        instances.append(Instance(form.qp.at(**given), given))
        q = _done(made, q, instances[-1])
    return Recorded(tuple(instances), _truths(instances), about)


def _done(made: Arm, q: Array, instance: Instance) -> Array:
    """The posture after one period of the QP's answer; the same without one."""
    solver = DaqpSession(mode="cold")
    solver.setup(instance)
    x = solver.solve().x
    if x is None:
        return q
    limits = made.kin.robot.limits
    return np.clip(q + PERIOD_S * x[: q.size], limits.lower, limits.upper)


def _truths(instances: list[Instance]) -> tuple[str, ...]:
    """By a certificate, or by an answer of DAQP that passed our check."""
    truths = []
    for instance in instances:
        solver = DaqpSession(mode="cold")
        solver.setup(instance)
        if solver.solve().x is not None:
            truths.append(SOLVABLE)
        else:
            known = find_farkas(instance.problem) is not None
            truths.append(INFEASIBLE if known else UNKNOWN)
    return tuple(truths)


def circle(made: Arm) -> Recorded:
    """Once round a circle in the plane y, z."""

    def path(s: float) -> Array:
        turn = 2.0 * np.pi * s
        return made.size * np.array([0.0, np.cos(turn) - 1.0, np.sin(turn)])

    return track(made, path, "once round a circle")


def figure8(made: Arm) -> Recorded:
    """A lying eight in the plane y, z."""

    def path(s: float) -> Array:
        turn = 2.0 * np.pi * s
        return made.size * np.array([0.0, np.sin(turn), 0.5 * np.sin(2.0 * turn)])

    return track(made, path, "a figure eight")


def singular(made: Arm) -> Recorded:
    """A small circle about a posture whose Jacobian has nearly lost rank."""
    J = made.kin.functions()["jacobian"]
    drawn = _drawn_postures(made, 2000)
    least = [np.linalg.svd(np.asarray(J(q)), compute_uv=False)[2] for q in drawn]
    nearly = drawn[int(np.argmin(np.abs(np.array(least) - NEAR)))]
    recorded = circle(Arm(made.kin, nearly, 0.1 * made.size))
    about = "a small circle where the Jacobian's least singular value starts at 0.01"
    return Recorded(recorded.instances, recorded.truth, about)


def _drawn_postures(made: Arm, count: int) -> Array:
    """Uniform in the middle nine tenths of the limits, (count, nv)."""
    bounds = made.kin.robot.limits
    low, high = np.maximum(bounds.lower, -np.pi), np.minimum(bounds.upper, np.pi)
    return np.random.default_rng(0).uniform(0.9 * low, 0.9 * high, (count, low.size))


def limits(made: Arm) -> Recorded:
    """A circle from a posture whose joints stand near their limits."""
    low, high = made.kin.robot.limits.lower, made.kin.robot.limits.upper
    span = np.where(np.isfinite(high - low), high - low, 2.0 * np.pi)
    near = np.where(np.isfinite(high), high - 0.03 * span, made.start)
    every_other = np.arange(low.size) % 2 == 0
    moved = Arm(made.kin, np.where(every_other, near, made.start), made.size)
    recorded = circle(moved)
    about = "a circle with every other joint at 3 % of its range from a limit"
    return Recorded(recorded.instances, recorded.truth, about)


def infeasible(made: Arm) -> Recorded:
    """A circle asked for too fast in the middle third."""
    recorded = figure8(made)
    form = minimum_velocity(made.kin)
    instances = list(recorded.instances)
    for k in range(COUNT // 3, 2 * COUNT // 3):
        given = {
            "q": instances[k].parameters["q"],
            "rd_dot": instances[k].parameters["rd_dot"] + np.array([0.0, 60.0, 0.0]),
        }
        instances[k] = Instance(form.qp.at(**given), given)
    about = "a figure eight whose middle third asks for 60 m/s: no solution there"
    return Recorded(tuple(instances), _truths(instances), about)


def obstacles(made: Arm) -> Recorded:
    """Towards a point while three spheres touch planes in the way."""
    name = made.kin.robot.name
    spheres = contacts(name) if name in ARMS else contacts("ur5")
    form = clearance_rows(made.kin, contacts=spheres, safe=SAFE_M)
    tip, centres = made.tip, made.kin.functions()["sphere_centres"]
    q, home = made.start.copy(), np.asarray(tip(made.start)).ravel()
    goal = home + made.size * np.array([0.0, 2.0, 1.0])
    wall = np.array([0.0, -1.0, 0.0])
    first = np.asarray(centres(q)).reshape(3, -1)[:, spheres]
    walls = wall @ first - SAFE_M - 0.1 * made.size
    instances = []
    for _ in range(COUNT):
        here = np.asarray(centres(q)).reshape(3, -1)[:, spheres]
        gaps = wall @ here - walls
        normals = np.tile(wall[:, None], (1, len(spheres)))
        given = {"q": q.copy(), "rd": goal, "normals": normals, "clearances": gaps}
        instances.append(Instance(form.qp.at(**given), given))
        q = _done(made, q, instances[-1])
    about = "towards a goal behind a plane: rows of obstacles are active"
    return Recorded(tuple(instances), _truths(instances), about, "obstacles")


MOTIONS: dict[str, Callable[[Arm], Recorded]] = {
    "circle": circle,
    "figure8": figure8,
    "singular": singular,
    "limits": limits,
    "obstacles": obstacles,
    "infeasible": infeasible,
}
"""Motions by name; the window is planned, see ``catalogue``."""
