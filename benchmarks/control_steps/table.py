"""The page of what was seen of every controller."""

from __future__ import annotations

import time
from typing import Any

from benchmarks.control_steps.cases import Case
from rrnn_opt.emit import find_compiler
from rrnn_opt.study.environment import commit

STATUS = ("ok", "not finite", "bad step", "empty limits", "diverged", "out of range")
STATUS += ("step too long", "bad tolerance", "infeasible", "no answer")


def report(found: dict[Case, dict[str, Any]], command: str) -> str:
    """The table that is kept."""
    total = sum(sum(row["status"]) for row in found.values())
    broken = sum(row["broken"] for row in found.values())
    head = (
        "# Random control steps, monitor on",
        "",
        f"Made by `{command}` on {time.strftime('%Y-%m-%d', time.gmtime())}, commit"
        f" {commit() or 'unknown'}, {find_compiler().version}.",
        "",
        *_words(),
        "",
        f"**{total} steps, {broken} broken promises.**",
        "",
    )
    top = ("controller (exact solver behind it)", "steps", "ok", "exact solver")
    top += ("flagged", "refused, with the reason", "beyond limits: promised / flagged")
    lines = [top, ("---",) + ("---:",) * 4 + ("---", "---:")]
    lines += [_line(case, row) for case, row in found.items()]
    table = ["| " + " | ".join(line) + " |" for line in lines]
    return "\n".join([*head, *table]) + "\n"


def _words() -> tuple[str, ...]:
    return (
        "Of 96 requests 64 walk slowly, 16 jump, 16 hold anything: NaN, infinities,",
        "denormals, random bytes, angles beyond all limits.  *Refused* steps leave",
        "state and output untouched.  *Flagged*: the status is OK and the verdict says",
        "that the KKT residual is above the tolerance, so that the network has not",
        "settled; such an output is finite, but may lie beyond the limits.  All other",
        "outputs are *promised*: settled to the tolerance (0.01), or the exact",
        "solver's.  The last column is the largest distance beyond the limits (rad/s,",
        "or rad/s2), rounding set aside.",
    )


def _line(case: Case, row: dict[str, Any]) -> tuple[str, ...]:
    refused = (f"{n} {s}" for n, s in zip(row["status"][1:], STATUS[1:], strict=True))
    return (
        str(case),
        str(sum(row["status"])),
        str(row["status"][0]),
        str(row["fell_back"]),
        str(row["flagged"]),
        ", ".join(text for text in refused if not text.startswith("0 ")),
        f"{row['worst_promised']:.2g} / {row['worst_flagged']:.2g}",
    )
