"""The page of how commands ended, and what they left."""

from __future__ import annotations

import collections
import time

from rrnn_opt.study.environment import commit

GOOD = ("ended there", "ended before", "finished")
BAD = ("torn file", "lost row", "mixed package", "wrong status", "poor sentence")
BAD += ("hang", "other result")


def page(table: dict[tuple[str, str], collections.Counter[str]], command: str) -> str:
    """The page that is kept."""
    date = time.strftime("%Y-%m-%d", time.gmtime())
    kinds = (*GOOD, *BAD)
    rows = [("command", "ended by", *kinds)]
    rows += [
        (*key, *(str(found[kind]) for kind in kinds)) for key, found in table.items()
    ]
    lines = ["| " + " | ".join(row) + " |" for row in rows]
    lines.insert(1, "|---|---|" + "---:|" * len(kinds))
    head = [
        "# Ended at any moment",
        "",
        f"`{command}` on {date}, commit {commit() or 'unknown'}.",
        "",
        "Commands ended at random moments of their time, the start of Python among it.",
        "*Ended there*: with the status of the signal, and with one sentence if it was",
        "asked to end; *ended before*: while Python still loaded the command;",
        "*finished*: the signal came too late.  Every fifth time the command is run",
        "again in what is left: *other result* counts those that differ from a run in",
        "an empty folder.",
        "",
    ]
    return "\n".join([*head, *lines]) + "\n"
