"""Sections of the page of Table II."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from rrnn_opt.validation.tables.cell import markdown
from rrnn_opt.validation.tables.table_2_rows import GOALS, Result, best
from rrnn_opt.validation.tables.tracking import CIRCLES, ENTRIES, SIGMAS

_COLUMNS = [f"sigma {s:g}" for s in SIGMAS]


def sections(found: Sequence[Result]) -> Iterator[str]:
    """The page's sections, in order."""
    n = found[0].errors.shape[2]
    yield (
        "Mean error in mm, +- half of the 95 % interval of the mean, (deviation of a "
        f"single run); {n} noise seeds on each of {len(CIRCLES)} circles, the same for "
        "all rows.  *paper* are its numbers, in mm."
    )
    yield _errors(found)
    yield "## Against the goals\n\n" + "\n".join(_verdicts(found))
    yield "## Circle by circle\n\nMean error in mm.\n\n" + _circles(found)
    yield "## Limits\n\n" + _limits(found)
    yield "## The search of the gains\n\n" + _search(found)


def _errors(found: Sequence[Result]) -> str:
    rows = []
    for row in found:
        entry, shown = ENTRIES[row.key], []
        for i in range(len(SIGMAS)):
            low, high = row.interval(i)
            deviation = row.errors[i].std(axis=1, ddof=1).mean() if _many(row) else 0.0
            shown.append(
                f"{1e3 * row.means[i]:.3f} +- {5e2 * (high - low):.3f} "
                f"({1e3 * deviation:.3f})"
            )
        paper = " / ".join(f"{1e3 * x:g}" for x in entry.paper) or "-"
        rows.append([entry.label, *shown, paper, entry.note])
    return markdown(["scheme", *_COLUMNS, "paper", "note"], rows)


def _many(row: Result) -> bool:
    return bool(row.errors.shape[2] > 1)


def _verdicts(found: Sequence[Result]) -> Iterator[str]:
    for i, sigma in enumerate(SIGMAS):
        mine, other, apart = best(found, i)
        low, high = mine.interval(i)
        reached = "reached" if high <= GOALS[i] else "not reached"
        least = min(e.paper[i] for e in ENTRIES.values() if e.paper)
        words = [
            f"* sigma {sigma:g}: our best, *{ENTRIES[mine.key].label}*, has "
            f"{1e3 * mine.means[i]:.3f} mm [{1e3 * low:.3f}, {1e3 * high:.3f}];",
            f"the goal of {1e3 * GOALS[i]:g} mm is {reached};",
            f"the least of the paper's numbers at this sigma is {1e3 * least:g} mm;",
            f"the best other row, *{ENTRIES[other.key].label}*, has "
            f"{1e3 * other.means[i]:.3f} mm;",
            "the intervals do not overlap." if apart else "**the intervals overlap.**",
        ]
        yield " ".join(words)


def _circles(found: Sequence[Result]) -> str:
    header = ["scheme", *[f"{c}, {s:g}" for c in CIRCLES for s in SIGMAS]]
    rows = [
        [
            ENTRIES[row.key].label,
            *[
                f"{1e3 * row.errors[i, j].mean():.3f}"
                for j in range(len(CIRCLES))
                for i in range(len(SIGMAS))
            ],
        ]
        for row in found
    ]
    circles = [
        [name, ", ".join(f"{x:g}" for x in start), plane]
        for name, (start, plane) in CIRCLES.items()
    ]
    table = markdown(["circle", "start [deg]", "plane"], circles)
    return f"{markdown(header, rows)}\n\n{table}"


def _limits(found: Sequence[Result]) -> str:
    text = (
        "Share of the runs in which positions stayed within the limits and so did the "
        "commanded velocities (accelerations).  Noise acts behind the command: it can "
        "push a joint across a stop that the command respects.  *Not at rest* is the "
        "share of the periods in which the programme had no solution (its row and the "
        "bounds contradict each other) or the network had not settled.\n\n"
    )
    rows = [
        [
            ENTRIES[row.key].label,
            *[f"{100 * x:.1f} %" for x in row.limits],
            f"{100 * row.unsettled:.3f} %",
        ]
        for row in found
    ]
    return text + markdown(["scheme", *_COLUMNS, "not at rest"], rows)


def _search(found: Sequence[Result]) -> str:
    text = (
        "The same for every row: as many points, half log-uniform in the ranges and "
        "half around the best so far, scored by the geometric mean over the sigmas of "
        "the mean error over circles and two seeds that the table does not use.\n\n"
    )
    rows = []
    for row in found:
        entry = ENTRIES[row.key]
        scores = [t.score for t in row.trials if np.isfinite(t.score)]
        gains = ", ".join(f"{k} = {v:.4g}" for k, v in row.trials[0].gains.items())
        ranges = ", ".join(f"{k} {a:g}..{b:g}" for k, (a, b) in entry.ranges.items())
        spread = f"{1e3 * scores[0]:.3f} / {1e3 * float(np.median(scores)):.3f}"
        rows.append(
            [entry.label, ranges or "none", len(row.trials), gains or "-", spread]
        )
    head = ["scheme", "ranges", "points", "best gains", "best / median score [mm]"]
    return text + markdown(head, rows)
