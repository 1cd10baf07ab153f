"""Certified rate of the reduced law over a region, tile by tile, for minutes or hours.

    python -m rrnn_opt.validation.studies.region_map --robot pa10 --out DIR

Every finished tile is a line of DIR/tiles.jsonl; a run that is stopped goes on
with the next one.  At the end DIR/map.json and DIR/map.png hold the whole map.
The region is the robot's working box (``--half-width``), or with ``--whole`` all
of its position limits, where singular postures stay open, as they must.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from rrnn_opt.report import draw_region, write_text
from rrnn_opt.robot import Kinematics, Robot
from rrnn_opt.study import Lines
from rrnn_opt.validation.ending import ended
from rrnn_opt.verification.region import Region, RegionCell, RegionMap
from rrnn_opt.verification.region.cell import Law, Tools, certify_cell
from rrnn_opt.verification.region.certify import (
    assumptions_of,
    telling_joints,
    tiles,
)


def _write(found: RegionMap, folder: Path) -> None:
    """The map as data and as a picture."""
    document = found.to_dict()
    write_text(folder / "map.json", json.dumps(document, indent=1) + "\n")
    draw_region(document, folder / "map.png")


def _told(found: RegionMap) -> str:
    """One line for the terminal."""
    boxes = sum(cell.boxes for cell in found.cells)
    return (
        f"{found.robot}: {100 * found.share:.4g} % certified, {boxes} boxes,"
        f" sigma >= {found.sigma:.4g} m, alpha >= {found.rate:.4g} 1/s,"
        f" step <= {found.step:.4g} s; {found.time_s:.1f} s in this run\n"
    )


def main() -> int:
    """Go on where the last run ended."""
    given = _arguments()
    kinematics = Kinematics(Robot.builtin(given.robot))
    region = (
        _whole(kinematics)
        if given.whole
        else Region.working(kinematics, half_width=given.half_width)
    )
    law = Law(given.epsilon, given.error, None, 0.5, given.floor)
    tools = Tools.of(kinematics, None)
    pair = telling_joints(tools, region)
    given.out.mkdir(parents=True, exist_ok=True)
    begin = time.monotonic()
    cells = _finished(given, tools, law, list(tiles(region, pair, (given.grid,) * 2)))
    spent = time.monotonic() - begin
    found = RegionMap(
        kinematics.robot.name,
        region,
        pair,
        law.epsilon,
        law.error,
        law.floor,
        cells,
        assumptions_of(law),
        spent,
    )
    _write(found, given.out)
    sys.stdout.write(_told(found))
    return 0


def _finished(
    given: argparse.Namespace, tools: Tools, law: Law, work: list[tuple[Any, Any, Any]]
) -> tuple[RegionCell, ...]:
    """All tiles: those that stand in the folder, then what is left of the work."""
    lines = Lines(given.out / "tiles.jsonl")
    done = sum(1 for _ in lines)
    for item in work[done:]:
        cell = certify_cell(tools, law, *item, seconds=given.tile_seconds)
        lines.append(asdict(cell))
    return tuple(_cell(line) for line in lines)


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robot", default="pa10")
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--half-width", type=float, default=0.5)
    parser.add_argument("--whole", action="store_true")
    parser.add_argument("--grid", type=int, default=8)
    parser.add_argument("--tile-seconds", type=float, default=2.0)
    parser.add_argument("--epsilon", type=float, default=0.1)
    parser.add_argument("--error", type=float, default=0.1)
    parser.add_argument("--floor", type=float, default=0.02)
    return parser.parse_args()


def _whole(kinematics: Kinematics) -> Region:
    """All positions; a continuous joint once round."""
    limits = kinematics.robot.limits
    low, high = np.maximum(limits.lower, -np.pi), np.minimum(limits.upper, np.pi)
    centre, half = 0.5 * (low + high), 0.499 * (high - low)
    return Region(tuple(centre.tolist()), tuple(half.tolist()))


def _cell(row: dict[str, Any]) -> RegionCell:
    ends = {name: tuple(row[name]) for name in ("lower", "upper")}
    residue = row["residue"]
    if residue is not None:
        residue = (tuple(residue[0]), tuple(residue[1]))
    return RegionCell(**(row | ends | {"residue": residue}))


if __name__ == "__main__":
    sys.exit(ended(main))
