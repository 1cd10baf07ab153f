"""Cells of the report: the paper's value, ours from the rows, and a verdict.

Ours comes from rows of a study and from nothing else: without rows a cell says so.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from rrnn_opt.validation.reproduce.cell import (
    IMPOSSIBLE,
    NO_ROWS,
    NOT,
    Cells,
    Rows,
    cell,
)
from rrnn_opt.validation.reproduce.figure_cells import fig3, fig4, fig5, raven
from rrnn_opt.validation.tables import table_2, table_3, table_4
from rrnn_opt.validation.tables.printed import printed, printed_values
from rrnn_opt.validation.tables.table_2_rows import interval
from rrnn_opt.validation.tables.tracking import ENTRIES, SIGMAS
from rrnn_opt.validation.tables.trials import SCENARIOS

_A, _W = 0.9, 0.95
_BETA = _A + 1.0 - _W
CEILING = (math.sqrt(_BETA**2 + 4.0 * _W) - _BETA) / (2.0 * _W)
"""Where the cell (14) rests under I = 1: the zero of 1 - beta x - w x^2.  From below
it never gets beyond, whatever the 0/1 input and the time an exploration takes."""


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
            ours, bounds = float(errors.mean()), interval(errors.mean(axis=0))
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
