"""Table I: every cell decided by a check, beside the paper's word.

    python -m rrnn_opt.validation.tables.table_1 --runs 20 --out DIR

No verdict is written down here: each is what a check of ``checks`` found on
our model of the row (``models``).
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rrnn_opt.errors import RrnnError
from rrnn_opt.planning import Problem, plan
from rrnn_opt.report import write_text
from rrnn_opt.validation.ending import ended
from rrnn_opt.validation.tables import checks
from rrnn_opt.validation.tables.blocked import blocked, least
from rrnn_opt.validation.tables.checks import Finding, yes
from rrnn_opt.validation.tables.models import MODELS, Model
from rrnn_opt.validation.tables.page import spelled
from rrnn_opt.validation.tables.printed import printed, printed_row, rows_of
from rrnn_opt.validation.tables.starts import start_problem
from rrnn_opt.validation.tables.table_1_page import page

PROGRAM = "python -m rrnn_opt.validation.tables.table_1"

SCENE = "window"
"""Scenario in which completeness is put to the test."""

_ROLLOUTS = 300
"""Explorations that a planner of a row may make."""

PAPER = {row: " ".join(printed_row("I", row)) for row in rows_of("I")}
"""The paper's words of each row, in the order of ``columns``."""


@dataclass(frozen=True)
class Mark:
    """One cell.

    Attributes:
        row: as the paper names it.
        column: as the paper names it.
        paper: its word.
        ours: what the check found.
        reason: what it saw.
    """

    row: str
    column: str
    paper: str
    ours: str
    reason: str

    @property
    def verdict(self) -> str:
        """Whether both agree."""
        if self.ours == "unknown":
            return "cannot be reproduced as printed"
        return "reproduced" if self.ours == self.paper else "not reproduced"


def obstacle_avoidance(model: Model, *, runs: int) -> Finding:
    """Contacts in the programme, and kept where the scheme without them collides."""
    if not model.avoids:
        return "No", "nothing in the programme knows of obstacles"
    cases = blocked(model, runs)
    gaps = [least(model, case)[0] for case in cases]
    kept = sum(gap >= 0.0 for gap in gaps)
    text = f"a ball in the arm's way was cleared in {kept} of {len(cases)} motions"
    if not cases:
        return "unknown", "no motion was found in which the ball is in the way"
    return yes(kept == len(cases)), f"{text}; least clearance {1e3 * min(gaps):.1f} mm"


def completeness(model: Model, *, runs: int) -> Finding:
    """Whether it reaches a target behind an obstacle wherever that can be reached."""
    if not model.planner:
        avoids, why = obstacle_avoidance(model, runs=runs)
        return avoids, why
    solved = 0
    for index in range(runs):
        problem = Problem.from_dict(start_problem(SCENE, index))
        result = plan(problem, planner=model.planner, max_explorations=_ROLLOUTS)
        solved += result.solved
    text = (
        f"planner '{model.planner}' solved the {SCENE} from {solved} of {runs} starts "
        f"within {_ROLLOUTS} explorations"
    )
    if solved == runs:
        text += "; a promise for all problems is no measurement"
    return yes(solved == runs), text


def columns(runs: int) -> dict[str, Callable[[Model], Finding]]:
    """The check of each column, in the paper's order.

    Args:
        runs: random starts, noise seeds or motions of a check.
    """
    few = max(2, runs // 5)
    return {
        "global convergence": lambda m: checks.global_convergence(m, runs=runs),
        "theoretical error": checks.theoretical_error,
        "free of error accumulation": lambda m: checks.no_accumulation(m, seeds=few),
        "free of matrix inversion": checks.no_inversion,
        "physical limits": lambda m: checks.physical_limits(m, runs=runs),
        "smoothness": checks.smoothness,
        "obstacle avoidance": lambda m: obstacle_avoidance(m, runs=few),
        "planning completeness": lambda m: completeness(m, runs=few),
    }


def marks(runs: int = 5, rows: Sequence[Model] = MODELS) -> Iterator[Mark]:
    """All cells, as they are found.

    Args:
        runs: see ``columns``.
        rows: of the table.
    """
    for model in rows:
        for column in columns(runs):
            yield mark(model, column, runs=runs)


def mark(model: Model, column: str, *, runs: int = 5) -> Mark:
    """One cell.

    Args:
        model: of the row.
        column: of ``columns``.
        runs: see ``columns``.
    """
    try:
        ours, reason = columns(runs)[column](model)
    except RrnnError as error:
        ours, reason = "unknown", f"the check could not run: {error}"
    return Mark(model.row, column, printed("I", model.row, column), ours, reason)


def cells(found: Sequence[Mark] | None = None, *, command: str = PROGRAM) -> list[Any]:
    """The cells in the form of ``rrnn reproduce --json``.

    Args:
        found: marks; a small run by default.
        command: that made them.
    """
    return [
        {
            "table": "I",
            "row": m.row,
            "column": m.column,
            "paper": m.paper,
            "ours": m.ours,
            "verdict": m.verdict,
            "reason": m.reason,
            "command": command,
        }
        for m in (list(marks()) if found is None else found)
    ]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run, print the page and write it.

    Args:
        arguments: of the command line.
    """
    parser = argparse.ArgumentParser(prog=PROGRAM, description="Table I.")
    add = parser.add_argument
    add("--runs", type=int, default=5, help="random starts of a check")
    add("--out", type=Path, help="folder of table_1.md and table_1.json")
    given = parser.parse_args(arguments)
    words = sys.argv[1:] if arguments is None else list(arguments)
    command, found = spelled(PROGRAM, words), []
    for mark in marks(given.runs):
        found.append(mark)
        print(f"{mark.row}, {mark.column}: {mark.ours}", file=sys.stderr, flush=True)
    text = page(found, command)
    print(text)
    if given.out is not None:
        given.out.mkdir(parents=True, exist_ok=True)
        write_text(given.out / "table_1.md", text)
        data = json.dumps({"cells": cells(found, command=command)}, indent=1) + "\n"
        write_text(given.out / "table_1.json", data)
    return 0


if __name__ == "__main__":
    sys.exit(ended(main))
