"""Does any learning rule beat a coin?  Readings of (14) and other rules, paired.

    python -m rrnn_opt.validation.studies.learning --trials 1000 --jobs 2 --out DIR

Each rule sees the same starts and seeds as the fair coin.  Constant
probabilities show what a rule without memory can reach at best.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np

from rrnn_opt.networks import MemoryCell
from rrnn_opt.planning import RandomRnn
from rrnn_opt.planning.settings.planners import PlannerSettings
from rrnn_opt.report.files import write_text
from rrnn_opt.validation.ending import ended
from rrnn_opt.validation.studies.searching import (
    Searches,
    picked,
    run_study,
    summary,
)
from rrnn_opt.validation.tables.cell import markdown
from rrnn_opt.validation.tables.table_4 import gain

COIN = "fair coin"


@dataclass(frozen=True)
class GainCell(MemoryCell):
    """The cell (14) with I = ``gain`` after a failure.

    Attributes:
        gain: of the input.
    """

    gain: float = 8.0

    def flow(self, x: ca.SX, stimulus: ca.SX) -> ca.SX:
        """Activity after one exploration."""
        return super().flow(x, self.gain * stimulus)


@dataclass(frozen=True)
class EulerCell(MemoryCell):
    """The cell (14) in one explicit Euler step an exploration, held in [0, 1].

    ``duration`` is the step; with 1 it jumps, which (14) itself does not.
    """

    def flow(self, x: ca.SX, stimulus: ca.SX) -> ca.SX:
        """Activity after one exploration."""
        after = x + self.duration * self.derivative(x, stimulus)
        return ca.fmin(ca.fmax(after, 0), 1)


@dataclass(frozen=True)
class LeakyCell(MemoryCell):
    """Running estimate of the share of failures: x moves to I by ``rate``.

    Attributes:
        rate: share of the way, in (0, 1].
        floor: least probability of either choice.
    """

    rate: float = 0.2
    floor: float = 0.05

    def flow(self, x: ca.SX, stimulus: ca.SX) -> ca.SX:
        """Activity after one exploration."""
        after = x + self.rate * (stimulus - x)
        return ca.fmin(ca.fmax(after, self.floor), 1 - self.floor)


@dataclass(frozen=True)
class SuccessCell(MemoryCell):
    """The cell (14) the other way round: I = 1 when the target was reached."""

    def flow(self, x: ca.SX, stimulus: ca.SX) -> ca.SX:
        """Activity after one exploration."""
        return super().flow(x, 1 - stimulus)


@dataclass(frozen=True)
class HeuristicFirst(MemoryCell):
    """No learning but for the first exploration, which is heuristic.

    Attributes:
        probability: of a random exploration from the second one on.
    """

    probability: float = 0.5

    def flow(self, x: ca.SX, stimulus: ca.SX) -> ca.SX:
        """Activity after one exploration."""
        return ca.SX(self.probability)


VARIANTS: dict[str, PlannerSettings] = {
    COIN: RandomRnn(coin=0.5),
    "cell (14)": RandomRnn(),
    "(14), input gain 8": RandomRnn(cell=GainCell()),
    "(14), 0.3 units of time": RandomRnn(cell=MemoryCell(duration=0.3)),
    "(14), 3 units of time": RandomRnn(cell=MemoryCell(duration=3.0)),
    "(14), Euler step 0.5": RandomRnn(cell=EulerCell(duration=0.5)),
    "(14), Euler step 1, held in [0, 1]": RandomRnn(cell=EulerCell()),
    "(14), w = 0.85 < A": RandomRnn(cell=MemoryCell(self_excitation=0.85)),
    "failure rate, leaky": RandomRnn(cell=LeakyCell()),
    "heuristic first, then a fair coin": RandomRnn(cell=HeuristicFirst()),
    "heuristic first, then 0.64": RandomRnn(cell=HeuristicFirst(probability=0.64)),
    "heuristic first, then 0.9": RandomRnn(cell=HeuristicFirst(probability=0.9)),
    "heuristic first, then 1": RandomRnn(cell=HeuristicFirst(probability=1.0)),
    "(14), I = success": RandomRnn(cell=SuccessCell()),
    "always 0.1": RandomRnn(coin=0.1),
    "always 0.25": RandomRnn(coin=0.25),
    "always 0.75": RandomRnn(coin=0.75),
    "always 1": RandomRnn(coin=1.0),
}


def gains(rows: Sequence[dict[str, Any]], study: Searches) -> str:
    """Mean total of the fair coin over that of each rule, paired, in Markdown."""
    lines = []
    for scene in study.scenarios:
        coin = np.array([r["total"] for r in picked(rows, scene, COIN)], dtype=float)
        for variant in study.variants:
            mine = picked(rows, scene, variant)
            totals = np.array([r["total"] for r in mine], dtype=float)
            ratio, low, high = gain(coin, totals)
            more, fewer = np.mean(totals > coin), np.mean(totals < coin)
            shares = (f"{fewer:.1%}", f"{more:.1%}")
            lines.append((scene, variant, ratio, f"{low:.3g} to {high:.3g}", *shares))
    head = ("scenario", "rule", "coin / rule", "95 % interval", "fewer", "more")
    return markdown(head, lines)


def main(argv: Sequence[str] | None = None) -> Path:
    """Run what is missing, write ``learning.md`` and return its path."""
    study, rows, made, out = run_study(
        "learning", VARIANTS, argv, trials=1000, budget=20_000
    )
    text = (
        f"# Learning rules\n\n{made}\n\n{gains(rows, study)}\n\n"
        f"{summary(rows, study)}\n"
    )
    return write_text(out / "learning.md", text)


if __name__ == "__main__":
    sys.exit(ended(main))
