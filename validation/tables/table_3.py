"""Table III: how often each scheme reaches the target, in both scenarios.

    python -m rrnn_opt.validation.tables.table_3 --trials 50 --jobs 2 --out DIR

A trial succeeds when the motion is delivered with a proof.  The paper prints no
dimensions, so scenes and starts are this project's; see ``scene.library``.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from rrnn_opt.report.files import write_text
from rrnn_opt.study import wilson
from rrnn_opt.validation.ending import ended
from rrnn_opt.validation.tables.cell import Cell, judged, markdown
from rrnn_opt.validation.tables.collect import collect, surroundings
from rrnn_opt.validation.tables.printed import printed
from rrnn_opt.validation.tables.trials import SCENARIOS, TRIALS, PlanningTrials

PRINTED = ("paper", "paper, I = failure", "paper, coin")
COLUMNS = {
    "method1": "Method1",
    "method2": "Method2",
    "random-rnn": "Proposed",
    **dict.fromkeys(PRINTED, "Proposed"),
}
PAPER = {
    (scene, planner): printed("III", f"Scenario {1 + k}", column)
    for k, scene in enumerate(SCENARIOS)
    for planner, column in COLUMNS.items()
}
"""Success rates of table III; both the repaired planner and Algorithm 1 as
printed are held against its column "Proposed"."""
REASON = {
    "method1": "a reconstruction, in scenes and from starts of our own",
    "method2": "a reconstruction, in scenes and from starts of our own",
    "paper": "Algorithm 1 as printed; collisions alone feed the cell",
    "paper, I = failure": "Algorithm 1 as printed; every failure feeds the cell",
    "paper, coin": "Algorithm 1 as printed with a fair coin for the cell",
    "no-learning": "the repaired planner with a fair coin for the cell",
    "random-rnn": "the repaired planner, in scenes and from starts of our own",
}
HEADER = (
    "scenario",
    "planner",
    "paper",
    "success",
    "95 % interval",
    "n",
    "p50 ms",
    "p95 ms",
    "verdict",
)


def of(
    rows: Sequence[dict[str, Any]], scenario: str, planner: str
) -> list[dict[str, Any]]:
    """The trials of one planner in one scenario."""
    return [r for r in rows if (r["scenario"], r["planner"]) == (scenario, planner)]


def cells(rows: Sequence[dict[str, Any]], command: str) -> list[Cell]:
    """Success rates as cells, where the paper has a number.

    Args:
        rows: metrics of ``PlanningTrials``.
        command: that made them.
    """
    found = [
        _cell(of(rows, scenario, planner), scenario, planner, command)
        for scenario in SCENARIOS
        for planner in TRIALS
        if (scenario, planner) in PAPER
    ]
    return [cell for cell in found if cell.n]


def _rate(mine: Sequence[dict[str, Any]]) -> tuple[float, tuple[float, float]]:
    solved, n = sum(r["solved"] for r in mine), len(mine)
    return solved / max(n, 1), wilson(solved, n)


def _cell(
    mine: Sequence[dict[str, Any]], scenario: str, planner: str, command: str
) -> Cell:
    printed, (share, interval) = PAPER[scenario, planner], _rate(mine)
    verdict = judged(printed, share, interval, larger_is_better=True)
    if planner in PRINTED and verdict == "not reproduced":
        verdict = "cannot be reproduced as printed"
    return Cell(
        table="III",
        row=scenario_title(scenario),
        column=planner,
        paper=printed,
        ours=share,
        interval=interval,
        n=len(mine),
        verdict=verdict,
        reason=REASON[planner],
        command=command,
    )


def scenario_title(scenario: str) -> str:
    """Name of a scenario in the tables."""
    return f"scenario {1 + SCENARIOS.index(scenario)} ({scenario})"


def page(rows: Sequence[dict[str, Any]], command: str) -> str:
    """The table in Markdown, with the planners that the paper has not."""
    verdicts = {(c.row, c.column): c.verdict for c in cells(rows, command)}
    lines = []
    for scenario in SCENARIOS:
        for planner in TRIALS:
            mine = of(rows, scenario, planner)
            if not mine:
                continue
            share, (low, high) = _rate(mine)
            printed, times = (
                PAPER.get((scenario, planner)),
                [r["plan_ms"] for r in mine],
            )
            lines.append(
                (
                    scenario_title(scenario),
                    planner,
                    None if printed is None else f"{printed:.0%}",
                    f"{share:.1%}",
                    f"{low:.1%} to {high:.1%}",
                    len(mine),
                    float(np.percentile(times, 50)),
                    float(np.percentile(times, 95)),
                    verdicts.get((scenario_title(scenario), planner)),
                )
            )
    return markdown(HEADER, lines)


def arguments(description: str, argv: Sequence[str] | None) -> argparse.Namespace:
    """Arguments of both planning tables."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--trials", type=int, default=50)
    parser.add_argument("--printed", type=int, help="trials of Algorithm 1 as printed")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--out", type=Path, default=Path("runs"))
    return parser.parse_args(argv)


def planning_rows(args: argparse.Namespace, table: int) -> tuple[list[Any], str]:
    """Metrics of the trials, and the command that makes them."""
    printed = "" if args.printed is None else f" --printed {args.printed}"
    command = (
        f"python -m rrnn_opt.validation.tables.table_{table} --trials {args.trials}"
        f"{printed} --jobs {args.jobs}"
    )
    study = PlanningTrials(trials=args.trials, printed=args.printed)
    folder = args.out / "planning_trials"
    return collect(study, folder, jobs=args.jobs), command


def main(argv: Sequence[str] | None = None) -> Path:
    """Run what is missing, write ``table_3.md`` and return its path."""
    args = arguments("Table III", argv)
    rows, command = planning_rows(args, 3)
    text = f"# Table III: success\n\n{surroundings(command)}\n\n{page(rows, command)}\n"
    return write_text(args.out / "table_3.md", text)


if __name__ == "__main__":
    sys.exit(ended(main))
