"""Which solver when: sentences that follow from the numbers by fixed rules."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from rrnn_opt.study.cases import Row
from rrnn_opt.study.comparison.catalogue import GROUPS
from rrnn_opt.study.comparison.profiles import TimeTable, time_table
from rrnn_opt.study.comparison.summary import summaries

SHOWN = 4


def advice(rows: Sequence[Row], sets: Sequence[str]) -> list[str]:
    """Sentences on control streams, single problems, infeasibility and deadlines.

    Args:
        rows: of ``Comparison``.
        sets: names of its sets.
    """
    streams = [name for name in sets if name in GROUPS["streams"]]
    drawn = [name for name in sets if name not in streams]
    told = []
    for label, names in (("control streams", streams), *((n, [n]) for n in drawn)):
        sentence = _fastest(label, time_table(rows, names)) if names else ""
        told += [sentence] if sentence else []
    told += _deadline(time_table(rows, streams)) if streams else []
    return [*told, *_infeasible(rows)]


def _fastest(label: str, table: TimeTable) -> str:
    """Who solved all, by median time; who came nearest where nobody did."""
    if not table.times.size:
        return ""
    solved = np.isfinite(table.times).mean(axis=1)
    full = solved >= solved.max()
    medians = {
        name: float(np.median(times[np.isfinite(times)]))
        for name, times, ok in zip(table.names, table.times, full, strict=True)
        if ok and np.isfinite(times).any()
    }
    ranked = sorted(medians, key=lambda name: medians[name])[:SHOWN]
    if not ranked:
        return f"**{label}**: nobody solved a problem."
    share = "all" if solved.max() == 1.0 else f"{solved.max():.1%} of"
    listed = "; ".join(f"{name}: {medians[name]:.3g} us" for name in ranked)
    return (
        f"**{label}**: {len(medians)} of {len(table.names)} solved {share} "
        f"{table.times.shape[1]} problems; the fastest of them by median: {listed}."
    )


def _deadline(table: TimeTable) -> list[str]:
    """Who is within a millisecond on every problem, by the worst of the medians."""
    if not table.times.size:
        return []
    worst = table.times.max(axis=1)
    kept = [table.names[k] for k in np.argsort(worst) if worst[k] <= 1000.0]
    if not kept:
        return ["**1 kHz**: nobody solved every problem of the streams within 1 ms."]
    return [
        "**1 kHz**: within 1 ms on every problem of the streams (medians over the "
        f"passes): {'; '.join(kept)}."
    ]


def _infeasible(rows: Iterable[Row]) -> list[str]:
    """Who called an infeasible problem solved, and who handed out numbers."""
    claims: dict[str, int] = {}
    numbers: dict[str, int] = {}
    asked: dict[str, int] = {}
    for found in summaries(rows):
        told = found.get("infeasible")
        if told is None:
            continue
        who = found["solver"]
        asked[who] = asked.get(who, 0) + told["n"]
        claims[who] = claims.get(who, 0) + told["claims"]
        odd = sum(v for k, v in told["handed"].items() if k not in ("none", "NaN"))
        numbers[who] = numbers.get(who, 0) + odd
    if not asked:
        return []
    wrong = [f"{who} ({n} of {asked[who]})" for who, n in claims.items() if n]
    silent = [who for who in asked if not numbers[who] and not claims[who]]
    return [
        "**no solution**: called solved by " + (", ".join(wrong) or "nobody") + "; "
        "handed out no number on any of them: " + (", ".join(silent) or "nobody") + "."
    ]
