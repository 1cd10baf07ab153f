"""C38: the proposed planner always succeeds, Table III."""

from __future__ import annotations

from scipy import stats

from rrnn_opt.robot import Kinematics
from rrnn_opt.verification import Evidence, Remark

RUNS, SUCCESSES, METHOD_1 = 50, (50, 50), (46, 36)


def case(kinematics: Kinematics) -> Remark:
    """50 of 50 runs in two scenes: a sample, from which nothing is proved.

    Intervals of Clopper and Pearson, and Fisher's exact test against Method 1.

    Args:
        kinematics: not used; the table's own numbers are tested.
    """
    intervals = tuple(_interval(count) for count in SUCCESSES)
    chances = [
        stats.fisher_exact([[a, RUNS - a], [b, RUNS - b]]).pvalue
        for a, b in zip(SUCCESSES, METHOD_1, strict=True)
    ]
    low = intervals[0].interval[0]
    return Remark(
        id="C38",
        source="Table III",
        statement="the proposed planner succeeds in 100 % of all runs",
        kind="EVIDENCE_ONLY",
        reason=f"50 of 50 puts the rate above {low:.3f} with 95 % confidence; against "
        f"Method 1 Fisher's p is {chances[0]:.3f} in scenario 1 and {chances[1]:.1e} "
        "in scenario 2",
        evidence=intervals,
    )


def _interval(successes: int) -> Evidence:
    exact = stats.binomtest(successes, RUNS).proportion_ci(0.95, method="exact")
    return Evidence(
        "C38", "statistical", RUNS, (float(exact.low), float(exact.high)), 0
    )
