"""The demo: six stages, one table, one list of checks."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from rrnn_opt.demo import files, law, truth
from rrnn_opt.demo.outcome import Check, at_most, verdict
from rrnn_opt.planning import PlanResult, Problem, plan
from rrnn_opt.scene.library import scenario

Say = Callable[[str], None]


@dataclass(frozen=True)
class DemoReport:
    """What the demo found.

    Attributes:
        rows: at most ten rows of (what, value).
        checks: questions with their answers.
        files: what was written.
        seconds: wall time, s.
    """

    rows: tuple[tuple[str, str], ...]
    checks: tuple[Check, ...]
    files: tuple[Path, ...]
    seconds: float

    @property
    def passed(self) -> bool:
        """Every check passed."""
        return all(check.passed for check in self.checks)

    def to_dict(self) -> dict[str, Any]:
        """The report, ready for JSON."""
        return {
            "passed": self.passed,
            "rows": [list(row) for row in self.rows],
            "checks": [check.to_dict() for check in self.checks],
            "files": [str(path) for path in self.files],
            "time_s": self.seconds,
        }


def run(out: Path, *, seed: int = 0, say: Say | None = None) -> DemoReport:
    """Plan, prove, compare and generate for the PA10 in front of a window.

    Args:
        out: folder for the files.
        seed: of the start and of the search.
        say: called with one line a stage.

    Raises:
        CompilerError: there is no C compiler.
        OSError: ``out`` cannot be written.
    """
    begin = time.perf_counter()
    tell = say or (lambda _: None)
    window = scenario("window")
    start = int(np.random.default_rng(seed).integers(len(window.starts)))
    problem = Problem.from_dict(window.problem(start))
    tell(
        f"PA10-7C, {problem.robot.nv} joints; wall with a 0.30 m window; start {start}"
    )
    written = law.write_law(problem.robot)
    tell(f"law, networks (6) and (17), V and V': {_built(written)}")
    result = plan(problem, seed=seed)
    tell(f"plan: {result.status}, {result.message}")
    if result.trajectory is None:
        failed = verdict("plan", result.status, "solved")
        return DemoReport((), (failed,), (), time.perf_counter() - begin)
    checks = _checks(written, result, seed, tell)
    tell("writing picture, page, trajectory and controller")
    paths = files.write_all(out, result, written)
    rows = _rows(written, result)
    return DemoReport(rows, checks, paths, time.perf_counter() - begin)


def _built(written: law.Law) -> str:
    how = "cached" if written.program.built.cached else "compiled"
    return f"{how}, {written.seconds:.2f} s"


def _checks(
    written: law.Law, result: PlanResult, seed: int, tell: Say
) -> tuple[Check, ...]:
    certificate = result.certificate
    checks = [
        law.check_compiled(written, np.random.default_rng(seed)),
        verdict(
            "trajectory free of collisions", certificate["collision_free"], "PROVED"
        ),
        verdict("trajectory within limits", certificate["limits"], "PROVED"),
        at_most("tip at the target", certificate["goal_error"], 1e-3, "m"),
        truth.check_checker(result.to_dict()),
    ]
    tell("settling two claims")
    checks += truth.check_claims(written)
    tell("comparing equilibria with OSQP and DAQP")
    checks += truth.check_equilibria(written, result)
    return tuple(checks)


def _rows(written: law.Law, result: PlanResult) -> tuple[tuple[str, str], ...]:
    stats, certificate = result.stats, result.certificate
    assert result.trajectory is not None
    clearance = 1e3 * certificate["clearance_lower_bound"]
    total = stats.explorations
    return (
        ("status", result.status),
        (
            "explorations",
            f"{total} ({stats.random} random, {stats.heuristic} heuristic)",
        ),
        ("certified steps", f"{stats.rollout_steps}"),
        ("plan", f"{1e3 * stats.plan_time_s:.2f} ms"),
        ("refinement", f"{1e3 * stats.refine_time_s:.1f} ms"),
        ("retiming", f"{1e3 * stats.retime_time_s:.1f} ms"),
        ("certificate", f"{1e3 * certificate['time_s']:.1f} ms"),
        ("trajectory", f"{result.trajectory['duration']:.2f} s"),
        ("proved clearance", f"{clearance:.3g} mm"),
        ("code in C", f"law {_built(written)}; planner {stats.compile_time_s:.2f} s"),
    )
