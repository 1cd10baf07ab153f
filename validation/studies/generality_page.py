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
    "code",
)


def page(
    rows: Sequence[Mapping[str, Any]],
    command: str,
    contacts: Mapping[str, Mapping[str, Mapping[str, float]]],
    limits: tuple[int, float],
) -> str:
    """Rows of ``generality.run`` as a page.

    Args:
        rows: one a scene.
        command: that made them.
        contacts: self-contact of each arm "before" spheres were added and "after".
        limits: explorations of our search, and s of processor time of OMPL's.
    """
    arms = list(dict.fromkeys(row["arm"] for row in rows))
    body = [_line([row for row in rows if row["arm"] == name]) for name in arms]
    lines = [
        "# Arms that nothing was tuned on, in random scenes",
        "",
        f"`{command}` for each ARM,",
        "SCENES the number that *solved* is of, with the code of the commit named"
        " at the end of",
        f"its line; {platform.machine()}, Python {platform.python_version()}.",
        "",
        f"{OBSTACLES} boxes, cylinders and spheres of {SIZE[0]:g} to {SIZE[1]:g} times"
        " the reach at random places",
        "and turns; joint goals; spheres fitted by `rrnn spheres`"
        f" (inflation {INFLATION:g} m, at most {MOST} a mesh).",
        "Solved means found *and* proved; a scene may have no solution.  Times are",
        "processor time of the solved ones, p50 / p95; *all* is search, shortening,",
        "retiming and proof.  OMPL's RRTConnect had the same scenes, the same compiled",
        "checker and the goal posture, edges checked every 1/32 rad; its time is that",
        "of its checks alone at their cost in C.  Limits: "
        f"{limits[0]} explorations for us,",
        f"{limits[1]:g} s of processor time for OMPL, whose checker is called through",
        "Python.  *Neither*: scenes that no planner solved.",
        "",
        *("| " + " | ".join(line) + " |" for line in (HEADER, ["---"] * len(HEADER))),
        *("| " + " | ".join(line) + " |" for line in body),
        "",
        *_unsolved(rows, arms),
        *_contacts(contacts),
    ]
    return "\n".join(lines) + "\n"


def kept_lines(text: str, commit: str, arms: Sequence[str]) -> str:
    """Lines of an earlier page, of arms that were not run again, with its commit.

    Args:
        text: the earlier page, with the columns of this one but the last.
        commit: that it is of.
        arms: that have lines of their own.
    """
    lines = [line for line in text.splitlines() if line.count("|") == len(HEADER)]
    names = ("arm", "---", *arms)
    kept = [line for line in lines if line.split("|")[1].strip() not in names]
    if not kept:
        return ""
    rows = [HEADER, ["---"] * len(HEADER)]
    table = ["| " + " | ".join(row) + " |" for row in rows]
    table += [f"{line.rstrip()} {commit} |" for line in kept]
    note = (
        f"These lines are those of this page at commit {commit}, where its limits and"
        " load stand:\nan earlier planner and earlier spheres."
    )
    return "\n".join(["", "## Not run again since", "", note, "", *table, ""])


def _unsolved(rows: Sequence[Mapping[str, Any]], arms: Sequence[str]) -> list[str]:
    """Scenes that only one planner solved, or none."""
    lines = ["## Scenes that are not solved", ""]
    for name in arms:
        mine = [row for row in rows if row["arm"] == name and "peer" in row]
        lost = [row for row in mine if row["status"] != "solved"]
        for what, found in (
            ("only RRTConnect found a path", [r for r in lost if r["peer"]]),
            ("neither did", [r for r in lost if not r["peer"]]),
            (
                "only we did",
                [r for r in mine if r["status"] == "solved" and not r["peer"]],
            ),
        ):
            scenes = ", ".join(str(row["scene"]) for row in found)
            if found:
                lines.append(f"- {name}, {what}: {len(found)} ({scenes})")
    if len(lines) == 2:
        lines.append("None.")
    return [
        *lines,
        "",
        "That no planner found a path does not prove that there is none.",
    ]


def _contacts(contacts: Mapping[str, Mapping[str, Mapping[str, float]]]) -> list[str]:
    """How often spheres of checked links overlap, and how often they need to."""
    lines = [
        "",
        "## Spheres against meshes",
        "",
        "Share of random postures in which checked links touch: by their spheres as"
        " first fitted, by",
        "the spheres used here, more of them where links pass each other closely, and"
        " by the geometry",
        "(coal).  What exceeds the last is forbidden falsely.",
        "",
        "| arm | postures | spheres first | spheres now | geometry |",
        "| --- | --- | --- | --- | --- |",
    ]
    for name, found in contacts.items():
        before, after = found["before"], found["after"]
        shares = (before["spheres"], after["spheres"], after["geometry"])
        cells = " | ".join(f"{share:.1%}" for share in shares)
        lines.append(f"| {name} | {after['postures']:.0f} | {cells} |")
    return lines if contacts else []


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
        ", ".join(sorted({str(row.get("commit") or "?") for row in mine})),
    )


def _times(seconds: Sequence[float]) -> str:
    if not seconds:
        return "-"
    p50, p95 = np.percentile(1e3 * np.array(seconds), [50, 95])
    return f"{p50:.2f} / {p95:.2f}"
