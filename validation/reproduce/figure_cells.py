"""Cells of the figures and of the Raven II: what the paper says of them, in words."""

from __future__ import annotations

import numpy as np

from rrnn_opt.study import wilson
from rrnn_opt.validation.reproduce.cell import (
    NO_ROWS,
    NOT,
    Cells,
    Rows,
    cell,
)
from rrnn_opt.validation.tables import table_3
from rrnn_opt.validation.tables.cell import judged
from rrnn_opt.validation.tables.tracking import ENTRIES, SIGMAS
from rrnn_opt.validation.tables.trials import SCENARIOS

GROWTH = 2.0
"""Growth of the mean square error that counts; the same in the check of Table I."""


def fig3(rows: Rows) -> Cells:
    """Whether the error grows along the circle: Table I's word on accumulation."""
    says = {"method1": "Yes", "method2": "Yes", "method3": "No", "proposed": "No"}
    found = {(r["key"], r["sigma"]): r for r in rows}
    result = []
    for sigma in SIGMAS:
        for key, paper in says.items():
            where = ("Fig. 3", ENTRIES[key].label, f"error grows, sigma = {sigma}")
            mine = found.get((key, sigma))
            if mine is None:
                result.append(cell(*where, paper, None, NOT, NO_ROWS, n=0))
                continue
            ratio = mine["last_m2"] / mine["first_m2"]
            ours = "Yes" if ratio > GROWTH else "No"
            reason = (
                f"mean square error of the last quarter over that of the first: "
                f"{ratio:.2f}, growth means more than {GROWTH:g}; the paper prints "
                "curves, and in its text that Methods 1 and 2 accumulate errors"
            )
            verdict = "reproduced" if ours == paper else NOT
            result.append(cell(*where, paper, ours, verdict, reason, n=mine["n"]))
    return result


def fig4(rows: Rows) -> Cells:
    """Whether the panel's motion reaches the target; the paper says so of (c), (f)."""
    found = {(r["scenario"], r["planner"]): r for r in rows}
    result = []
    for scene in SCENARIOS:
        where = (
            "Fig. 4",
            table_3.scenario_title(scene),
            "Proposed reaches the target",
            "Yes",
        )
        mine = found.get((scene, "random-rnn"))
        if mine is None:
            result.append(cell(*where, None, NOT, NO_ROWS, n=0))
            continue
        others = "; ".join(
            f"{name}: {found[scene, name]['status']}"
            for name in ("method1", "method2")
            if (scene, name) in found
        )
        ours = "Yes" if mine["reached"] else "No"
        verdict = "reproduced" if mine["reached"] else NOT
        result.append(cell(*where, ours, verdict, f"from one start of ours; {others}"))
    return result


def fig5(rows: Rows) -> Cells:
    """Whether the cell leans to random exploration where the scene is harder."""
    where = ("Fig. 5", "mean activity", "scenario 2 above scenario 1", "Yes")
    means = [[r["mean"] for r in rows if r["scenario"] == s] for s in SCENARIOS]
    if not all(means):
        return [cell(*where, None, NOT, NO_ROWS, n=0)]
    low, high = (float(np.mean(values)) for values in means)
    ours = "Yes" if high > low else "No"
    largest = max(r["largest"] for r in rows)
    reason = (
        f"Algorithm 1 as printed: {low:.3f} in scenario 1, {high:.3f} in scenario 2, "
        f"{largest:.3f} at most; the paper prints no numbers"
    )
    verdict = "reproduced" if ours == "Yes" else NOT
    return [cell(*where, ours, verdict, reason, n=len(rows))]


def raven(rows: Rows) -> Cells:
    """Success through the opening; the paper reports one run, and it succeeded."""
    where = ("Raven II", "through the 4 cm opening", "success", 1.0)
    if not rows:
        return [cell(*where, None, NOT, NO_ROWS, n=0)]
    solved = sum(bool(r["solved"]) for r in rows)
    bounds, share = wilson(solved, len(rows)), solved / len(rows)
    verdict = judged(1.0, share, bounds, larger_is_better=True)
    reason = "one run on the machine in the paper; a scene of ours, every motion proved"
    return [cell(*where, share, verdict, reason, bounds=bounds, n=len(rows))]
