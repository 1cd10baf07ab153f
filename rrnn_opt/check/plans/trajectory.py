"""The verdict on one trajectory: limits, collisions, start and goal.

``certify_trajectory`` judges what was delivered and nothing else: the cubic
Hermite polynomial between rows.  It knows nothing of how the rows were made.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rrnn_opt.check.plans import hermite, reading
from rrnn_opt.check.plans.collision.look import Effort
from rrnn_opt.check.plans.collision.parts import Parts
from rrnn_opt.check.plans.collision.proof import PROVED, UNKNOWN, Outcome, prove_free
from rrnn_opt.check.plans.collision.scene import Scene
from rrnn_opt.check.plans.goal import GoalError, nearest_goal
from rrnn_opt.check.plans.inputs import read_motion, read_scene
from rrnn_opt.check.plans.limits import prove_limits
from rrnn_opt.check.plans.motion import Motion
from rrnn_opt.check.plans.reading import Array
from rrnn_opt.check.plans.robot.block import read_model
from rrnn_opt.check.plans.robot.model import Model
from rrnn_opt.errors import DocumentError

METHOD = (
    "cubic Hermite pieces: exact extremes for limits; half-space and "
    "second-order motion bound with subdivision in time for collisions; "
    "rounding bounded by running error analysis (rounding_bound_m)"
)
EXACTLY = "; every interval proved again in ball arithmetic, limits in rationals"
START_TOLERANCE = 1e-9
MAX_BOXES = 200_000


@dataclass(frozen=True)
class TrajectoryCertificate:
    """What was shown about a trajectory.

    Attributes:
        collision_free: "PROVED", "REFUTED" or "UNKNOWN", for all times.
        limits: likewise, for position, velocity and acceleration.
        clearance_lower_bound: least distance of all pairs, proved, m; None
            when nothing was proved or there is no pair.
        goal_error: m, or rad for a joint goal; None without a goal.
        goal_angle_error: rad, or None.
        goal_reached: the goal error is within its tolerance.
        faults: what is wrong with the rows themselves, one sentence each.
        witness: {"time", "q", "pair", "distance", "required"} of a collision.
        limits_witness: {"kind", "coordinate", "time", "value", "limit"}.
        method: how it was shown.
        rounding_bound_m: what rounding can do to a distance at most, derived
            for this robot, motion and scene; already taken off, m.
        checks: (time box, pair) rows looked at.
        time_s: s.
    """

    collision_free: str
    limits: str
    clearance_lower_bound: float | None
    goal_error: float | None
    goal_angle_error: float | None
    goal_reached: bool
    faults: tuple[str, ...]
    witness: dict[str, Any] | None
    limits_witness: dict[str, Any] | None
    method: str
    rounding_bound_m: float | None
    checks: int
    time_s: float

    @property
    def proved(self) -> bool:
        """Both verdicts are PROVED, the goal is reached, the rows are sound."""
        proved = self.collision_free == PROVED and self.limits == PROVED
        return proved and self.goal_reached and not self.faults

    def to_dict(self) -> dict[str, Any]:
        """The "certificate" object of a plan, witnesses included."""
        names = self.__dataclass_fields__
        result = {name: getattr(self, name) for name in names}
        return {**result, "faults": list(self.faults)}


@dataclass(frozen=True, eq=False)
class Judge:
    """A robot, read once, whose trajectories are judged.

    Attributes:
        document: the robot block; nobody may change it from now on.
        model: what it says.
        parts: what of it must keep apart.
    """

    document: Any
    model: Model
    parts: Parts

    @staticmethod
    def of(robot: Any) -> Judge:
        """Of the robot block of a plan.

        Raises:
            DocumentError: it is malformed.
        """
        model = read_model(robot)
        return Judge(robot, model, Parts.of(model))

    def certify(
        self,
        problem: Any,
        trajectory: Any,
        *,
        max_boxes: int = MAX_BOXES,
        exact: bool = False,
    ) -> TrajectoryCertificate:
        """As :func:`certify_trajectory`."""
        began, model = time.perf_counter(), self.model
        wish = reading.mapping(problem, "problem")
        motion, qdd = read_motion(trajectory, model.nv)
        with np.errstate(all="ignore"):
            scene = read_scene(self.parts, wish, motion)
            limits, broken = prove_limits(model, motion, exact=exact)
            goal = read_goal(model, wish, motion)
            effort = Effort(max_boxes, keep_leaves=exact)
            found = prove_free(scene, motion, effort)
            faults = _faults(model, wish, motion, trajectory.get("duration"), qdd)
        if exact:
            found = _exactly(self.document, wish, scene, motion, found)
        result = _certificate(limits, broken, goal, found, faults, scene, began)
        return replace(result, method=METHOD + EXACTLY) if exact else result


def certify_trajectory(
    robot: Any,
    problem: Any,
    trajectory: Any,
    *,
    max_boxes: int = MAX_BOXES,
    exact: bool = False,
) -> TrajectoryCertificate:
    """Judge a trajectory for all times, not at samples.

    Args:
        robot: the robot block of a plan.
        problem: "obstacles", "margin", "start" and "goal" of a problem; what
            is absent is not asked for.
        trajectory: "t", "q", "qd" and, if present, "qdd".
        max_boxes: time boxes to look at before answering UNKNOWN.
        exact: prove every interval again in ball arithmetic, and limits in
            rational arithmetic; takes seconds.

    Raises:
        DocumentError: something in the three documents is malformed.
    """
    judge = Judge.of(robot)
    return judge.certify(problem, trajectory, max_boxes=max_boxes, exact=exact)


def _exactly(
    robot: Any, problem: Any, scene: Scene, motion: Motion, outcome: Outcome
) -> Outcome:
    """The outcome, if balls confirm every row of its proof."""
    from rrnn_opt.check.plans.exact.recheck import recheck
    from rrnn_opt.check.plans.exact.scene import BallScene

    if outcome.verdict != PROVED or outcome.leaves is None:
        return outcome
    again = recheck(BallScene(robot, problem, scene, motion), outcome.leaves)
    if again.proved:
        return outcome
    return replace(outcome, verdict=UNKNOWN, clearance=None)


def _certificate(
    limits: str,
    broken: dict[str, Any] | None,
    goal: GoalError | None,
    outcome: Outcome,
    faults: tuple[str, ...],
    scene: Scene,
    began: float,
) -> TrajectoryCertificate:
    bound = scene.rounding_bound
    return TrajectoryCertificate(
        collision_free=outcome.verdict,
        limits=limits,
        clearance_lower_bound=outcome.clearance,
        goal_error=None if goal is None else goal.error,
        goal_angle_error=None if goal is None else goal.angle,
        goal_reached=goal is None or goal.reached,
        faults=faults,
        witness=outcome.witness,
        limits_witness=broken,
        method=METHOD,
        rounding_bound_m=bound if np.isfinite(bound) else None,
        checks=outcome.checks,
        time_s=time.perf_counter() - began,
    )


def read_goal(model: Model, problem: Any, motion: Motion) -> GoalError | None:
    """Distance of the last row from the goal, None when there is no goal.

    Raises:
        DocumentError: the goal is malformed, or of another frame than the tip.
    """
    frame = problem.get("frame")
    if frame is not None and frame != model.tip[0]:
        raise DocumentError("problem.frame", f"the robot's tip is '{model.tip[0]}'")
    if problem.get("goal") is None:
        return None
    return nearest_goal(model, problem["goal"], motion.q[-1])


def _faults(
    model: Model, problem: Any, motion: Motion, duration: Any, qdd: Array | None
) -> tuple[str, ...]:
    found = []
    if problem.get("start") is not None:
        start = reading.numbers(problem["start"], (model.nv,), "problem.start")
        if float(np.abs(motion.q[0] - start).max()) > START_TOLERANCE:
            found.append("the first row is not the start")
    if np.any(motion.qd[0] != 0) or np.any(motion.qd[-1] != 0):
        found.append("the motion does not start and end at rest")
    if duration is not None:
        stated = reading.number(duration, "trajectory.duration")
        if abs(stated - motion.t[-1]) > 1e-9 * (1 + motion.t[-1]):
            found.append("duration is not the time of the last row")
    if qdd is not None and not _same_acceleration(motion.pieces, qdd):
        found.append("qdd is not the second derivative of the delivered motion")
    return tuple(found)


def _same_acceleration(pieces: hermite.Pieces, qdd: Array) -> bool:
    expected = hermite.second_derivatives(pieces)
    error = hermite.rounding(pieces)[2].max()
    allowed = 1e-6 * (1 + float(np.abs(expected).max())) + error
    return bool(np.all(np.abs(qdd - expected) <= allowed))
