"""Cells of the report: the paper's value, ours from the rows, and a verdict.

Ours comes from rows of a study and from nothing else: without rows a cell says so.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from rrnn_opt.study import wilson
from rrnn_opt.validation.tables import table_2, table_3, table_4
from rrnn_opt.validation.tables.cell import judged
from rrnn_opt.validation.tables.printed import printed, printed_values
from rrnn_opt.validation.tables.tracking import ENTRIES, SIGMAS
from rrnn_opt.validation.tables.trials import SCENARIOS

Rows = Sequence[Mapping[str, Any]]
Cells = list[dict[str, Any]]
NOT, IMPOSSIBLE = "not reproduced", "cannot be reproduced as printed"
NO_ROWS = "no row of the study is there"
_A, _W = 0.9, 0.95
_BETA = _A + 1.0 - _W
CEILING = (math.sqrt(_BETA**2 + 4.0 * _W) - _BETA) / (2.0 * _W)
"""Where the cell (14) rests under I = 1: the zero of 1 - beta x - w x^2.  From below
it never gets beyond, whatever the 0/1 input and the time an exploration takes."""


def cell(
    table: str,
    row: str,
    column: str,
    paper: Any,
    ours: Any,
    verdict: str,
    reason: str,
    *,
    bounds: Sequence[float] = (),
    n: int = 1,
) -> dict[str, Any]:
    """One cell in the form of ``rrnn reproduce --json``."""
    numbers = isinstance(paper, int | float) and isinstance(ours, int | float)
    return {
        "table": table,
        "row": row,
        "column": column,
        "paper": paper,
        "ours": ours,
        "interval": [float(b) for b in bounds],
        "difference": ours - paper if numbers else None,
        "n": n,
        "verdict": verdict,
        "reason": reason,
    }


def table1(rows: Rows) -> Cells:
    """Words against words."""
    found = {(r["row"], r["column"]): r for r in rows}
    result = []
    for (table, row, column), paper in printed_values().items():
        if table != "I":
            continue
        mine = found.get((row, column))
        if mine is None:
            result.append(cell("I", row, column, paper, None, NOT, NO_ROWS, n=0))
            continue
        verdict = "reproduced" if mine["ours"] == paper else NOT
        if mine["ours"] == "unknown":
            verdict = IMPOSSIBLE
        ours, saw, runs = mine["ours"], mine["saw"], mine["runs"]
        result.append(cell("I", row, column, paper, ours, verdict, saw, n=runs))
    return result


def table2(rows: Rows) -> Cells:
    """Mean errors, m, with Student's interval over the noise seeds."""
    found = {r["key"]: np.array(r["errors_m"]) for r in rows}
    result = []
    for key, entry in ENTRIES.items():
        for k, paper in enumerate(entry.paper):
            column = f"sigma = {SIGMAS[k]}"
            where = ("II", entry.label, column, paper)
            if key not in found:
                result.append(cell(*where, None, NOT, NO_ROWS, n=0))
                continue
            errors = found[key][k]
            ours, bounds = float(errors.mean()), table_2.interval(errors.mean(axis=0))
            word = table_2.verdict(entry, paper, ours, bounds)
            reason = f"{entry.note}; noise, circles and start are of our choice"
            result.append(
                cell(*where, ours, word, reason, bounds=bounds, n=errors.size)
            )
    return result


def table3(rows: Rows) -> Cells:
    """Success rates with Wilson's interval."""
    found = [c.to_dict() for c in table_3.cells(rows, "")]  # type: ignore[arg-type]
    keys = [
        (table_3.scenario_title(scene), planner, value)
        for (scene, planner), value in table_3.PAPER.items()
    ]
    return _completed("III", found, keys)


def table4(rows: Rows) -> Cells:
    """Mean explorations with bootstrap intervals, and the share of random steps."""
    found = [c.to_dict() for c in table_4.cells(rows, "")]  # type: ignore[arg-type]
    keys = [
        (table_3.scenario_title(scene), f"{planner} {short}", values[key])
        for (scene, planner), values in table_4.PAPER.items()
        for key, short in table_4.COUNTS.items()
    ]
    return _completed("IV", found, keys) + _shares(rows)


def _completed(table: str, found: Cells, keys: Sequence[tuple[str, str, Any]]) -> Cells:
    """The cells found, in order, and empty ones where there were no rows."""
    by_place = {(c["row"], c["column"]): c for c in found}
    result = []
    for row, column, paper in keys:
        mine = by_place.get((row, column))
        if mine is None:
            result.append(cell(table, row, column, paper, None, NOT, NO_ROWS, n=0))
            continue
        result.append(
            cell(
                *(table, row, column, paper, mine["ours"], mine["verdict"]),
                mine["reason"],
                bounds=mine["interval"],
                n=mine["n"],
            )
        )
    return result


def _shares(rows: Rows) -> Cells:
    """Random explorations over all, of Algorithm 1 as printed and of the variant."""
    result = []
    for k, scene in enumerate(SCENARIOS):
        random, total = (
            printed("IV", f"Scenario {1 + k}", f"Proposed {name}")
            for name in ("RE", "Total")
        )
        paper = round(random / total, 3)
        for planner, word in _LITERAL.items():
            mine = table_3.of(rows, scene, planner)  # type: ignore[arg-type]
            where = (
                "IV",
                table_3.scenario_title(scene),
                f"{planner} share of RE",
                paper,
            )
            if not mine:
                result.append(cell(*where, None, NOT, NO_ROWS, n=0))
                continue
            ours, bounds = _ratio(mine)
            reason = (
                f"{word}; the cell (14) with A = 0.9, w = 0.95 and a 0/1 input never "
                f"exceeds {CEILING:.4f}, so no mean share of {paper} can follow from it"
            )
            result.append(
                cell(*where, ours, IMPOSSIBLE, reason, bounds=bounds, n=len(mine))
            )
    return result


_LITERAL = {
    "paper, I = failure": "Algorithm 1 as printed",
    "random-rnn": "the repaired planner, a variant",
}


def _ratio(mine: Rows) -> tuple[float, tuple[float, float]]:
    """Sum of the random ones over the sum of all, with a bootstrap interval."""
    counts = np.array([[r["random"], r["total"]] for r in mine], dtype=float)

    def share(x: Any) -> Any:
        return x[..., 0].sum(axis=1) / np.maximum(x[..., 1].sum(axis=1), 1.0)

    return float(share(counts[None])[0]), table_4.bootstrap(counts, share)


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


MAKERS: dict[str, Callable[[Rows], Cells]] = {
    "table1": table1,
    "table2": table2,
    "table3": table3,
    "table4": table4,
    "fig3": fig3,
    "fig4": fig4,
    "fig5": fig5,
    "raven": raven,
}
