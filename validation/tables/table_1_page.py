"""The page of Table I."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rrnn_opt.validation.tables.cell import markdown
from rrnn_opt.validation.tables.models import MODELS
from rrnn_opt.validation.tables.page import head

if TYPE_CHECKING:
    from rrnn_opt.validation.tables.table_1 import Mark

_HOW = """\
* *global convergence*: the network comes to rest from random states; where the
  scheme measures the position, the tip also reaches fixed, reachable targets from
  random starts within 30 s, to 1 mm.
* *theoretical error*: what is left on a circle, started on it and without noise, as
  the control period goes to zero.
* *free of error accumulation*: under noise the mean square error of the fourth round
  is less than twice that of the first.
* *free of matrix inversion*: no division by data and no root in the graph of scheme
  and network, and neither declares an inverse.
* *physical limits*: positions, commanded speeds and accelerations, in motions of 4 s
  between random postures, feasible or not.
* *smoothness*: the velocity that the scheme asks for does not jump when it starts
  off target or a contact comes near; a network that lags smooths a jump over its
  time constant, which is not asked here.
* *obstacle avoidance*: the spheres that the scheme is told of keep clear of a ball
  where the same scheme, not told, goes through it.
* *planning completeness*: the row's planner solves the window from every start; no
  number of runs proves completeness, one failure refutes it for that budget."""


def page(found: Sequence[Mark], command: str) -> str:
    """The table and the reason of every cell, in Markdown."""
    rows = list(dict.fromkeys(m.row for m in found))
    names = list(dict.fromkeys(m.column for m in found))
    of = {(m.row, m.column): m for m in found}
    table = [[r, *[_shown(of[r, c]) for c in names]] for r in rows]
    differ = [m for m in found if m.ours != m.paper]
    agree = [m for m in found if m.ours == m.paper]
    standing = [
        [m.row, m.scheme.__name__, type(m.network).__name__, m.standing]
        for m in MODELS
        if m.row in rows
    ]
    about = (
        "What a check found on our model of each row; **bold**, with the paper's word, "
        f"where they differ: {len(differ)} of {len(found)} cells."
    )
    parts = [
        head("Table I", command),
        about,
        _HOW,
        markdown(["", *names], table),
        "## What stands in each row",
        markdown(["row", "scheme", "network", "it is"], standing),
        "## Where we differ, and why",
        markdown(_REASONS, _lines(differ)),
        "## Where we agree",
        markdown(_REASONS, _lines(agree)),
    ]
    return "\n\n".join(parts) + "\n"


_REASONS = ("row", "column", "paper", "ours", "what was seen")


def _shown(mark: Mark) -> str:
    same = mark.ours == mark.paper
    return mark.ours if same else f"**{mark.ours}** (paper: {mark.paper})"


def _lines(found: Sequence[Mark]) -> list[list[str]]:
    return [[m.row, m.column, m.paper, m.ours, m.reason] for m in found]
