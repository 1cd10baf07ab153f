"""What each part of the repaired planner is worth: one switched off at a time.

    python -m rrnn_opt.validation.studies.ablation --trials 200 --jobs 2 --out DIR

Every variant sees the same starts and seeds.  Times are those of the search
alone, goal postures included.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from rrnn_opt.planning import RandomRnn
from rrnn_opt.planning.settings.planners import PlannerSettings
from rrnn_opt.validation.ending import ended
from rrnn_opt.validation.studies.searching import compared

VARIANTS: dict[str, PlannerSettings] = {
    "all on": RandomRnn(),
    "no projection: stop at contact": RandomRnn(project=False),
    "no tip drive": RandomRnn(drive=False),
    "no memory cell: fair coin": RandomRnn(coin=0.5),
    "no memory cell: always random": RandomRnn(coin=1.0),
    "no memory cell: never random": RandomRnn(coin=0.0),
    "no connecting slide": RandomRnn(connect=False),
    "attractions drawn uniformly": RandomRnn(edge=1),
    "all off": RandomRnn(project=False, drive=False, coin=0.5, connect=False),
}


def main(argv: Sequence[str] | None = None) -> Path:
    """Run what is missing, write ``ablation.md`` and return its path."""
    return compared("ablation", "Ablations", VARIANTS, argv, trials=200, budget=2000)


if __name__ == "__main__":
    sys.exit(ended(main))
