"""Stages 4 and 5: claims settled, and the network against QP solvers."""

from __future__ import annotations

import copy
from collections.abc import Sequence
from typing import Any

import numpy as np

from rrnn_opt import check
from rrnn_opt.demo.law import Law
from rrnn_opt.demo.outcome import Check, at_most, verdict
from rrnn_opt.motion import Trajectory
from rrnn_opt.planning import PlanResult
from rrnn_opt.solving import (
    Comparison,
    DaqpSession,
    OsqpSession,
    SettledNetwork,
    Solver,
    Tolerances,
    compare,
    record_stream,
)
from rrnn_opt.validation.claims import c17, c18
from rrnn_opt.validation.claims.expected import surprises

SHIFT_M = 0.02


def check_claims(law: Law) -> list[Check]:
    """(19) as an identity, proved; V' <= 0 along (17), refuted; both mutated."""
    checks = []
    for case, name in (
        (c18.case(law.kinematics), "(19) V' = -e'J P(J'e/eps) along (18)"),
        (c17.case(law.kinematics), "V' <= 0 along (17), as printed"),
    ):
        settled = case.settle()
        note = "" if settled.mutant is None else f"mutation {settled.mutant.status}"
        row = settled.row()
        found = row["verdict"]
        checks.append(
            verdict(name, found, surprises([row]).get(row["id"], found), note)
        )
        if not settled.caught:
            checks.append(Check(f"{name}: mutation", False, note, "another verdict"))
    return checks


def check_equilibria(law: Law, result: PlanResult) -> list[Check]:
    """Network (6) against OSQP and DAQP on the QPs along the motion."""
    assert result.trajectory is not None
    motion = Trajectory.from_dict(result.trajectory)
    stream = record_stream(law.velocity, motion, kinematics=law.kinematics, count=40)
    limits = Tolerances()
    solvers: list[Solver] = [SettledNetwork(law.network), OsqpSession(), DaqpSession()]
    rows = compare(stream, solvers, tolerances=limits)
    network, *others = dict.fromkeys(row.solver for row in rows)
    residual = max(r.residual.worst for r in rows if r.solver == network)
    name = f"network at rest, KKT residual on {len(stream)} QPs"
    checks = [at_most(name, residual, limits.residual)]
    for solver in others:
        mine = [r for r in rows if r.solver == solver]
        label = f"network against {solver}"
        checks.append(at_most(f"{label}, velocity", _worst(mine, "primal"), 1e-6))
        duals = max(_worst(mine, "equality"), _worst(mine, "box"))
        checks.append(at_most(f"{label}, duals", duals, limits.dual))
    return checks


def _worst(rows: Sequence[Comparison], field: str) -> float:
    """Largest finite entry; multipliers that are not unique are NaN."""
    values = np.array([getattr(row, field) for row in rows])
    if field == "primal" or not np.any(np.isfinite(values)):
        return float(np.max(values))
    return float(np.nanmax(values))


def check_checker(document: dict[str, Any]) -> Check:
    """The wall moved by 2 cm each way: at least one motion must be refuted."""
    worst = "PROVED"
    for axis in (1, 2):
        for sign in (-1.0, 1.0):
            problem = copy.deepcopy(document["problem"])
            for obstacle in problem["obstacles"]:
                obstacle["position"][axis] += sign * SHIFT_M
            again = check.certify_trajectory(
                document["robot"], problem, document["trajectory"]
            )
            if again.collision_free == "REFUTED" and again.witness is not None:
                worst = "REFUTED"
    return verdict("the same motion with the window moved 2 cm", worst, "REFUTED")
