"""The tables of a comparison's report, in Markdown."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from rrnn_opt.report.markdown import markdown_table
from rrnn_opt.solving import TIGHT
from rrnn_opt.solving.conic import PLUGINS
from rrnn_opt.study.comparison.measure import Comparison

Found = Sequence[Mapping[str, Any]]

_HEAD = (
    *("solver", "mode", "n", "solved", "95 % interval", "relative", "wrong claims"),
    *("p50", "p95", "p99", "p99.9", "worst", "mean", "inner", "spread", "first"),
    *("iterations", "primal", "dual", "gap"),
)


def answers_table(rows: Found) -> str:
    """Times and residuals of every solver on one set, most solved first."""
    lines = []
    for row in rows:
        times = row["time_us"]
        if times is None:
            continue
        low, high = row["wilson"]
        lines.append(
            (
                *(row["solver"], row["mode"], row["n"], row["solved"]),
                f"{low:.1%} to {high:.1%}",
                *(row["solved_relative"], row["claims_wrongly"]),
                *(_short(times[k]) for k in ("p50", "p95", "p99", "p999", "max")),
                *(_short(row["mean_us"]), _short(row["inner_us"])),
                f"{row['spread']:.0%}",
                *(_short(row["first_us"]), _short(row["iterations"])),
                *(_small(row[k]) for k in ("primal", "dual", "gap")),
            )
        )
    if not lines:
        return "Nothing here has a solution; see the table of infeasible problems."
    order = sorted(lines, key=lambda line: (-line[3], float(line[7])))
    return markdown_table(_HEAD, order)


def unfinished(rows: Found) -> list[str]:
    """Who did not finish, as a sentence, if anyone."""
    lost = [r for r in rows if r.get("error")]
    return [
        "Did not finish: "
        + "; ".join(f"{r['solver']}, {r['mode']} ({r['error']})" for r in lost)
        + "."
    ] * bool(lost)


def gains_table(rows: Found) -> str:
    """Cold over warm and over stream, of the shifted geometric means."""
    means = {
        (r["stream"], r["solver"], r["mode"]): r["mean_us"]
        for r in rows
        if r.get("mean_us")
    }
    gains: dict[str, dict[str, list[float]]] = {}
    for (stream, solver, mode), mean in means.items():
        cold = means.get((stream, solver, "cold"))
        if mode != "cold" and cold is not None:
            gains.setdefault(solver, {}).setdefault(mode, []).append(cold / mean)
    lines = [
        (solver, *(_gain(found.get(mode)) for mode in ("warm", "stream")))
        for solver, found in sorted(gains.items())
    ]
    if not lines:
        return "No sequence was run in two modes."
    text = "Geometric mean over the sequences of cold / warm and cold / stream."
    return f"{text}\n\n{markdown_table(('solver', 'warm', 'stream'), lines)}"


def _gain(ratios: list[float] | None) -> str | None:
    return None if not ratios else f"{np.exp(np.mean(np.log(ratios))):.2f}"


def infeasible_table(rows: Found) -> str:
    """What was said and handed out where there is no solution."""
    lines = []
    for row in rows:
        told = row.get("infeasible")
        if told is None:
            continue
        handed = ", ".join(f"{k} {v}" for k, v in told["handed"].items())
        times = told["time_us"]
        lines.append(
            (
                *(row["stream"], row["solver"], row["mode"], told["n"]),
                told["claims"],
                handed,
                *(_short(times[k]) for k in ("p50", "max")),
            )
        )
    head = ("set", "solver", "mode", "n", "called solved", "handed out", "p50", "worst")
    return (
        "Infeasible by a Farkas certificate that is checked here. *handed out*: what "
        "stood in x.\n\n" + markdown_table(head, lines)
    )


def solvers_table(study: Comparison) -> str:
    """Method, licence, version and settings of all who were asked."""
    lines = []
    for who in study.solvers:
        plugin = who.name.removeprefix("casadi-")
        given = (
            PLUGINS.get(plugin, {}) if plugin != who.name else TIGHT.get(who.name, {})
        )
        settings = ", ".join(f"{k} {v}" for k, v in given.items()) or "its own"
        version = f"{who.package} {who.version()}"
        lines.append((who.name, who.method, who.licence, version, settings))
    head = ("solver", "method", "licence", "package", "settings")
    return markdown_table(head, lines)


def _short(value: float | None) -> str | None:
    if value is None:
        return None
    return f"{value:.0f}" if value >= 100 else f"{value:.3g}"


def _small(value: float | None) -> str | None:
    return None if value is None else f"{value:.0e}"
