"""The page of ``generality``."""

from __future__ import annotations

import platform
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from rrnn_opt.study import wilson
from rrnn_opt.validation.studies.arms import INFLATION, MOST
from rrnn_opt.validation.studies.clutter import OBSTACLES, SIZE

HEADER = (
    "arm",
    "joints",
    "spheres",
    "solved",
    "95 % interval",
    "search [ms]",
    "all [ms]",
    "other ends",
    "RRTConnect found",
    "its checks in C [ms]",
    "neither",
)


def page(
    rows: Sequence[Mapping[str, Any]], command: str, limits: tuple[float, float]
) -> str:
    """Rows of ``generality.run`` as a page.

    Args:
        rows: one a scene.
        command: that made them.
        limits: of our search and of OMPL's, s on the wall.
    """
    arms = list(dict.fromkeys(row["arm"] for row in rows))
    body = [_line([row for row in rows if row["arm"] == name]) for name in arms]
    lines = [
        "# Arms that nothing was tuned on, in random scenes",
        "",
        f"`{command}`, {platform.machine()}, Python {platform.python_version()}.",
        "",
        f"{OBSTACLES} boxes, cylinders and spheres of {SIZE[0]:g} to {SIZE[1]:g} times"
        " the reach at random places",
        "and turns; joint goals; spheres fitted by `rrnn spheres`"
        f" (inflation {INFLATION:g} m, at most {MOST} a mesh).",
        "Solved means found *and* proved; a scene may have no solution.  Times are of"
        " the solved",
        "ones, p50 / p95; *all* is search, shortening, retiming and proof."
        "  OMPL's RRTConnect had",
        "the same scenes, the same compiled checker and the goal posture, edges checked"
        " every 1/32 rad;",
        "its time is that of its checks alone at their cost in C.  Limits:"
        f" {limits[0]:g} s on the wall for us,",
        f"{limits[1]:g} s for OMPL, whose checker is called through Python."
        "  *Neither*: scenes that",
        "no planner solved.",
        "",
        *("| " + " | ".join(line) + " |" for line in (HEADER, ["---"] * len(HEADER))),
        *("| " + " | ".join(line) + " |" for line in body),
    ]
    return "\n".join(lines) + "\n"


def _line(mine: Sequence[Mapping[str, Any]]) -> tuple[str, ...]:
    solved = [row for row in mine if row["status"] == "solved"]
    low, high = wilson(len(solved), len(mine))
    others = Counter(row["status"] for row in mine if row["status"] != "solved")
    peers = [row for row in mine if "peer" in row]
    found = [row for row in peers if row["peer"]]
    neither = [row for row in peers if not row["peer"] and row["status"] != "solved"]
    return (
        mine[0]["arm"],
        str(mine[0]["joints"]),
        str(mine[0]["spheres"]),
        f"{len(solved)}/{len(mine)}",
        f"{low:.3f} to {high:.3f}",
        _times([row["plan_s"] for row in solved]),
        _times([row["all_s"] for row in solved]),
        ", ".join(f"{v} {k}" for k, v in sorted(others.items())) or "none",
        f"{len(found)}/{len(peers)}" if peers else "-",
        _times([row["peer_s"] for row in found]),
        str(len(neither)) if peers else "-",
    )


def _times(seconds: Sequence[float]) -> str:
    if not seconds:
        return "-"
    p50, p95 = np.percentile(1e3 * np.array(seconds), [50, 95])
    return f"{p50:.2f} / {p95:.2f}"
