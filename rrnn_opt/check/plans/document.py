"""Re-check a plan document: what it claims against what can be shown of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from rrnn_opt.check.plans import reading
from rrnn_opt.check.plans.collision.proof import PROVED
from rrnn_opt.check.plans.reading import get
from rrnn_opt.check.plans.trajectory import TrajectoryCertificate, certify_trajectory
from rrnn_opt.errors import DocumentError

STATUSES = (
    "solved",
    "uncertified",
    "budget_exhausted",
    "time_limit",
    "no_goal_posture",
    "infeasible",
    "interrupted",
    "invalid_problem",
)
SAME_ERROR = 1e-6
"""A stated goal error may differ by this from the one found, m or rad."""
SAME_CLEARANCE = 1e-3
"""A stated clearance may exceed the one found by this or a tenth, m: both are
lower bounds, refined only so far."""


@dataclass(frozen=True)
class PlanCheck:
    """What an independent look at a plan document found.

    Attributes:
        status: as the document states it.
        certificate: found anew, None when there is no trajectory.
        disagreements: where the document says more than can be shown.
    """

    status: str
    certificate: TrajectoryCertificate | None
    disagreements: tuple[str, ...]

    @property
    def holds(self) -> bool:
        """All is PROVED, the goal reached, and nothing overstated."""
        shown = self.certificate is not None and self.certificate.proved
        return shown and not self.disagreements

    def to_dict(self) -> dict[str, Any]:
        """JSON-ready."""
        found = self.certificate
        return {
            "kind": "plan",
            "holds": self.holds,
            "status": self.status,
            "certificate": None if found is None else found.to_dict(),
            "disagreements": list(self.disagreements),
        }


def check_plan(document: Any, *, exact: bool = False) -> PlanCheck:
    """Derive the verdicts of a plan anew from its robot, problem and trajectory.

    Args:
        document: a plan result, as read from JSON.
        exact: prove every interval again in ball arithmetic; takes seconds.

    Raises:
        DocumentError: it is not a plan result, or is malformed.
    """
    plan = reading.mapping(document, "plan")
    status = reading.text(get(plan, "status", ""), "status")
    if status not in STATUSES:
        raise DocumentError("status", f"must be of {', '.join(STATUSES)}")
    if plan.get("trajectory") is None:
        missing = ("it says solved, but there is no trajectory",)
        return PlanCheck(status, None, missing if status == "solved" else ())
    problem = reading.mapping(get(plan, "problem", ""), "problem")
    for key in ("start", "goal", "obstacles"):
        if problem.get(key) is None:
            raise DocumentError(f"problem.{key}", "is missing")
    robot, rows = get(plan, "robot", ""), plan["trajectory"]
    found = certify_trajectory(robot, problem, rows, exact=exact)
    stated = plan.get("certificate")
    claims = {} if stated is None else reading.mapping(stated, "certificate")
    return PlanCheck(status, found, _disagreements(status, claims, found))


def _disagreements(
    status: str, stated: Mapping[str, Any], found: TrajectoryCertificate
) -> tuple[str, ...]:
    wrong = []
    if status == "solved" and not found.proved:
        wrong.append("it says solved, but not all of it can be proved")
    for key in ("collision_free", "limits"):
        if stated.get(key) == PROVED != getattr(found, key):
            wrong.append(f"it says {key} PROVED, but it is {getattr(found, key)}")
    wrong += _numbers(stated, found)
    return tuple(wrong)


def _numbers(stated: Mapping[str, Any], found: TrajectoryCertificate) -> list[str]:
    wrong = []
    for key in ("goal_error", "goal_angle_error"):
        ours = getattr(found, key)
        if stated.get(key) is None or ours is None:
            continue
        theirs = reading.number(stated[key], f"certificate.{key}")
        if abs(theirs - ours) > SAME_ERROR:
            wrong.append(f"it says {key} {theirs:g}, but it is {ours:g}")
    key = "clearance_lower_bound"
    if stated.get(key) is not None:
        theirs = reading.number(stated[key], f"certificate.{key}")
        ours = found.clearance_lower_bound
        room = max(SAME_CLEARANCE, 0.1 * abs(theirs))
        if ours is None or theirs > ours + room:
            shown = "nothing" if ours is None else f"{ours:g}"
            wrong.append(f"it says {key} {theirs:g}, but {shown} can be shown")
    return wrong
