"""Readings of Algorithm 1: what its open choices change.

python -m rrnn_opt.validation.studies.readings --trials 50 --jobs 2 --out DIR
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from itertools import product
from pathlib import Path

from rrnn_opt.planning import PaperRnn
from rrnn_opt.planning.settings.planners import PlannerSettings
from rrnn_opt.planning.settings.rollout import Feed, Order, Reading, Region
from rrnn_opt.validation.ending import ended
from rrnn_opt.validation.studies.searching import compared

ORDERS: tuple[Order, ...] = ("first", "second")
SETS: tuple[Reading, ...] = ("transpose", "index")
REGIONS: tuple[Region, ...] = ("ball", "posture")
FEEDS: tuple[Feed, ...] = ("contact", "failure")
VARIANTS: dict[str, PlannerSettings] = {
    f"{order}-order, (12) by {reading}, {region}, I = {feed}": PaperRnn(
        order=order, reading=reading, region=region, feed=feed
    )
    for order, reading, region, feed in product(ORDERS, SETS, REGIONS, FEEDS)
}
"""By the fields of ``PaperRnn`` that change what the print can mean."""


def main(argv: Sequence[str] | None = None) -> Path:
    """Run what is missing, write ``readings.md`` and return its path."""
    title = "Readings of Algorithm 1"
    return compared("readings", title, VARIANTS, argv, trials=50, budget=300)


if __name__ == "__main__":
    sys.exit(ended(main))
