"""The picture of a comparison: profiles, accuracy against time, percentiles."""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from rrnn_opt.report.axes import INK
from rrnn_opt.report.save import save

LABELLED = 9
_COLOURS = (
    *("#3b6fb6", "#e08b2d", "#4a9d6e", "#b5527d", "#7a68b3", "#8a6d4b"),
    *("#4aa5b5", "#c0392b", "#6b7280"),
)
_PALE = "#d5d9e0"


def draw_profiles(
    data: Mapping[str, Any], summaries: Sequence[Mapping[str, Any]], *, title: str
) -> bytes:
    """Four panels as a PNG.

    Args:
        data: names, times (microseconds, None where not solved), worst relative
            residuals, and both profiles, of the same lines.
        summaries: rows with "label" and "time_us", for the percentiles.
        title: over the picture.
    """
    from matplotlib.figure import Figure

    figure = Figure(figsize=(13.0, 9.0), dpi=110, facecolor="white")
    figure.set_layout_engine("constrained")
    axes = figure.subplots(2, 2)
    figure.suptitle(title, fontsize=11, color=INK, x=0.01, ha="left")
    shown = _best(data)
    colours = {k: _COLOURS[i % len(_COLOURS)] for i, k in enumerate(shown)}
    _curves(axes[0][0], data, "ratios", "performance", colours)
    axes[0][0].set_title("within a factor of the fastest (Dolan-More)", fontsize=9)
    axes[0][0].set_xlabel("factor", fontsize=8)
    _curves(axes[0][1], data, "budgets_us", "data", colours)
    axes[0][1].set_title("solved within a time (data profile)", fontsize=9)
    axes[0][1].set_xlabel("time [us]", fontsize=8)
    _accuracy(axes[1][0], data, colours)
    _percentiles(axes[1][1], summaries)
    for axis in axes.ravel():
        axis.tick_params(labelsize=7)
        axis.title.set_color(INK)
        for side in ("top", "right"):
            axis.spines[side].set_visible(False)
    raw = io.BytesIO()
    save(figure, raw, format="png", metadata={"Software": None})
    return raw.getvalue()


def _best(data: Mapping[str, Any]) -> list[int]:
    """The lines that are named: largest area under the data profile."""
    areas = [float(np.mean(curve)) for curve in data["data"]]
    return sorted(range(len(areas)), key=lambda k: -areas[k])[:LABELLED]


def _curves(
    axes: Any, data: Mapping[str, Any], over: str, curves: str, colours: dict[int, str]
) -> None:
    for k, curve in enumerate(data[curves]):
        if k not in colours:
            axes.step(data[over], curve, color=_PALE, lw=0.8, where="post", zorder=1)
    for k, colour in colours.items():
        name = data["names"][k]
        axes.step(
            data[over], data[curves][k], color=colour, lw=1.6, where="post", label=name
        )
    axes.set_xscale("log")
    axes.set_ylim(-0.02, 1.03)
    axes.set_ylabel(f"share of {data['problems']} problems", fontsize=8)
    axes.grid(True, color="#e3e6ec", lw=0.6)
    axes.legend(fontsize=7, frameon=False, loc="lower right")


def _accuracy(axes: Any, data: Mapping[str, Any], colours: dict[int, str]) -> None:
    """Worst relative residual of what was solved against the median time."""
    for k, (times, worst) in enumerate(zip(data["times"], data["worst"], strict=True)):
        solved = [t for t in times if t is not None]
        if not solved or worst is None:
            continue
        x, y = float(np.median(solved)), max(worst, 1e-17)
        full = len(solved) == len(times)
        colour = colours.get(k, "#9aa1ad")
        axes.plot(x, y, "o", ms=6, color=colour, mfc=colour if full else "none")
        axes.annotate(
            data["names"][k],
            (x, y),
            fontsize=6,
            xytext=(4, 2),
            textcoords="offset points",
            color=colour if k in colours else "#6b7280",
        )
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.margins(x=0.15, y=0.1)
    axes.grid(True, color="#e3e6ec", lw=0.6)
    axes.set_xlabel("median time [us]", fontsize=8)
    axes.set_ylabel("worst relative residual", fontsize=8)
    title = "accuracy against time (hollow: did not solve all)"
    axes.set_title(title, fontsize=9)


def _percentiles(axes: Any, summaries: Sequence[Mapping[str, Any]]) -> None:
    """From the median to the worst, one line a solver."""
    rows = [row for row in summaries if row["time_us"] is not None]
    rows = sorted(rows, key=lambda row: row["time_us"]["p50"])[:26][::-1]
    for k, row in enumerate(rows):
        t = row["time_us"]
        axes.plot([t["p50"], t["max"]], [k, k], color="#c5ccd8", lw=2, zorder=1)
        for name, mark, colour in (
            ("p50", "o", "#3b6fb6"),
            ("p95", "|", "#2b2f38"),
            ("p99", "|", "#e08b2d"),
            ("max", ".", "#c0392b"),
        ):
            label = name if k == 0 else None
            axes.plot(t[name], k, mark, color=colour, ms=6, label=label)
    axes.set_yticks(range(len(rows)), [row["label"] for row in rows], fontsize=6)
    axes.set_xscale("log")
    axes.grid(True, axis="x", color="#e3e6ec", lw=0.6)
    axes.set_xlabel("time of one solve [us]", fontsize=8)
    axes.set_title("from the median to the worst", fontsize=9)
    axes.legend(fontsize=7, frameon=False, loc="lower left")
