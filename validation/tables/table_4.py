"""Table IV: random, heuristic and total explorations, with and without learning.

    python -m rrnn_opt.validation.tables.table_4 --trials 50 --jobs 2 --out DIR

"Without learning" is the same planner with a fair coin in place of the cell
(14).  Trials are paired: trial i has the same start and seed in both columns.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.report.files import write_text
from rrnn_opt.validation.ending import ended
from rrnn_opt.validation.tables.cell import Cell, judged, markdown
from rrnn_opt.validation.tables.collect import surroundings
from rrnn_opt.validation.tables.printed import printed
from rrnn_opt.validation.tables.table_3 import arguments, of, planning_rows
from rrnn_opt.validation.tables.trials import SCENARIOS

Array = NDArray[np.float64]
COUNTS = {"random": "RE", "heuristic": "HS", "total": "Total"}
COLUMNS = {"no-learning": "Without Learning", "random-rnn": "Proposed"}
PAPER = {
    (scene, planner): {
        key: printed("IV", f"Scenario {1 + k}", f"{column} {short}")
        for key, short in COUNTS.items()
    }
    for k, scene in enumerate(SCENARIOS)
    for planner, column in COLUMNS.items()
}
"""Mean explorations of table IV; "random-rnn" stands for "Proposed"."""
PAIRS = (("no-learning", "random-rnn"), ("paper, coin", "paper, I = failure"))
RESAMPLES = 10_000


def bootstrap(
    values: Array,
    statistic: Callable[[Array], Array],
    *,
    seed: int = 0,
) -> tuple[float, float]:
    """95 % percentile bootstrap interval.

    Args:
        values: one row a trial, (n, k); rows are drawn whole.
        statistic: of resamples (m, n, k), one number each.
        seed: of the resampling.
    """
    rng = np.random.default_rng(seed)
    drawn: list[Array] = []
    for _ in range(10):
        index = rng.integers(len(values), size=(RESAMPLES // 10, len(values)))
        drawn.append(statistic(values[index]))
    low, high = np.percentile(np.concatenate(drawn), [2.5, 97.5])
    return float(low), float(high)


def mean_interval(values: Array) -> tuple[float, float]:
    """Bootstrap interval of the mean of (n,)."""
    return bootstrap(values[:, None], lambda x: x.mean(axis=(1, 2)))


def gain(without: Array, proposed: Array) -> tuple[float, float, float]:
    """Ratio of the mean totals, without over with learning, and its interval.

    Args:
        without: totals without learning, (n,).
        proposed: totals of the same trials with the cell, (n,).
    """
    pairs = np.stack([without, proposed], axis=1).astype(float)
    low, high = bootstrap(pairs, lambda x: x[..., 0].mean(1) / x[..., 1].mean(1))
    return float(without.mean() / proposed.mean()), low, high


def cells(rows: Sequence[dict[str, Any]], command: str) -> list[Cell]:
    """Mean explorations as cells.

    Args:
        rows: metrics of ``PlanningTrials``.
        command: that made them.
    """
    result = []
    for (scenario, planner), counts in PAPER.items():
        mine = of(rows, scenario, planner)
        for key, column in COUNTS.items() if mine else ():
            values = np.array([r[key] for r in mine], dtype=float)
            interval, mean = mean_interval(values), float(values.mean())
            result.append(
                Cell(
                    table="IV",
                    row=f"scenario {1 + SCENARIOS.index(scenario)} ({scenario})",
                    column=f"{planner} {column}",
                    paper=counts[key],
                    ours=mean,
                    interval=interval,
                    n=len(mine),
                    verdict=judged(counts[key], mean, interval, larger_is_better=False),
                    reason="another steering, in scenes and from starts of our own",
                    command=command,
                )
            )
    return result


def page(rows: Sequence[dict[str, Any]], command: str) -> str:
    """Both tables in Markdown: the counts, then the gain from learning."""
    counts = [
        (
            cell.row,
            cell.column,
            cell.paper,
            cell.ours,
            f"{cell.interval[0]:.4g} to {cell.interval[1]:.4g}",
            cell.n,
            cell.verdict,
        )
        for cell in cells(rows, command)
    ]
    head = ("scenario", "planner", "paper", "ours", "95 % interval", "n", "verdict")
    return f"{markdown(head, counts)}\n\n## Gain from learning\n\n{gains(rows)}"


_GAINS = (
    *("scenario", "mean totals", "paper", "ours", "95 % interval"),
    *("cell needs fewer", "cell needs more", "pairs"),
)


def gains(rows: Sequence[dict[str, Any]]) -> str:
    """Paired comparison of the cell with the fair coin, in Markdown."""
    lines = []
    for without, proposed in PAIRS:
        for scenario in SCENARIOS:
            first, second = (
                np.array([r["total"] for r in of(rows, scenario, name)], dtype=float)
                for name in (without, proposed)
            )
            if len(first) != len(second) or not len(first):
                continue
            ratio, low, high = gain(first, second)
            printed = _printed(scenario) if without == "no-learning" else None
            found = (f"{without} / {proposed}", printed, ratio)
            shares = (np.mean(second < first), np.mean(second > first))
            words = (f"{low:.3g} to {high:.3g}", *(f"{share:.1%}" for share in shares))
            lines.append((scenario, *found, *words, len(first)))
    return markdown(_GAINS, lines)


def _printed(scenario: str) -> float:
    """The paper's ratio of mean totals."""
    totals = [PAPER[scenario, name]["total"] for name in ("no-learning", "random-rnn")]
    return float(totals[0] / totals[1])


def main(argv: Sequence[str] | None = None) -> Path:
    """Run what is missing, write ``table_4.md`` and return its path."""
    args = arguments("Table IV", argv)
    rows, command = planning_rows(args, 4)
    text = (
        f"# Table IV: explorations\n\n{surroundings(command)}\n\n"
        f"{page(rows, command)}\n"
    )
    return write_text(args.out / "table_4.md", text)


if __name__ == "__main__":
    sys.exit(ended(main))
