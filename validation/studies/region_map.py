"""Certified rate of the reduced law over a region, tile by tile, for minutes or hours.

    python -m rrnn_opt.validation.studies.region_map --robot pa10 --out DIR

Every finished tile is a line of DIR/tiles.jsonl with what was asked; a run that
is stopped goes on with the tiles that are missing, and takes none of another robot,
region or law.  At the end DIR/map.json and DIR/map.png hold the whole map.
The region is the robot's working box (``--half-width``), or with ``--whole`` all
of its position limits, where singular postures stay open, as they must.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from rrnn_opt.report import draw_region, write_text
from rrnn_opt.report.region_map import percent
from rrnn_opt.robot import Kinematics, Robot
from rrnn_opt.study import Lines
from rrnn_opt.validation.ending import ended
from rrnn_opt.verification.engines.interval.kernel import Array
from rrnn_opt.verification.region import Region, RegionCell, RegionMap
from rrnn_opt.verification.region.cell import Law, Tools, certify_cell
from rrnn_opt.verification.region.certify import (
    Tile,
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
        f"{found.robot}: {percent(found.share)} certified, {boxes} boxes,"
        f" sigma >= {found.sigma:.4g} m, alpha >= {found.rate:.4g} 1/s,"
        f" step <= {found.step:.4g} s; {found.time_s:.1f} s in this run\n"
    )


def main() -> int:
    """Go on where the last run ended."""
    given = _arguments()
    kinematics = Kinematics(Robot.builtin(given.robot))
    region = _region(kinematics, given)
    law = Law(given.epsilon, given.error, None, 0.5, given.floor)
    tools = Tools.of(kinematics, None)
    pair = telling_joints(tools, region)
    given.out.mkdir(parents=True, exist_ok=True)
    begin = time.monotonic()
    lines, work = (
        Lines(given.out / "tiles.jsonl"),
        tiles(region, pair, (given.grid,) * 2),
    )
    asked = {"robot": given.robot, "region": asdict(region), "law": asdict(law)}
    certified = partial(_certified, given, tools, law)
    cells = finished(lines, asked, list(work), certified)
    found = RegionMap(
        kinematics.robot.name,
        region,
        pair,
        law.epsilon,
        law.error,
        law.floor,
        cells,
        assumptions_of(law),
        time.monotonic() - begin,
    )
    _write(found, given.out)
    sys.stdout.write(_told(found))
    return 0


def finished(
    lines: Lines,
    asked: Mapping[str, Any],
    work: Sequence[tuple[Array, Array, Tile]],
    certified: Callable[[tuple[Array, Array, Tile]], RegionCell],
) -> tuple[RegionCell, ...]:
    """All tiles: those that are kept with the same question, and what is left.

    Args:
        lines: kept tiles, each with what was asked.
        asked: robot, region and law, as JSON holds them.
        work: the tiles.
        certified: makes the cell of a tile.
    """
    asked = json.loads(json.dumps(asked))
    kept = {_ends(r["cell"]): r["cell"] for r in lines if r.get("asked") == asked}
    for item in work:
        if item[2] not in kept:
            kept[item[2]] = asdict(certified(item))
            lines.append({"asked": asked, "cell": kept[item[2]]})
    return tuple(_cell(kept[item[2]]) for item in work)


def _certified(
    given: argparse.Namespace,
    tools: Tools,
    law: Law,
    item: tuple[Array, Array, Tile],
) -> RegionCell:
    return certify_cell(tools, law, *item, seconds=given.tile_seconds)


def _ends(row: Mapping[str, Any]) -> Tile:
    """The tile of a kept cell."""
    (a, b), (c, d) = row["lower"], row["upper"]
    return (a, b), (c, d)


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


def _region(kinematics: Kinematics, given: argparse.Namespace) -> Region:
    """The working box, or all positions; a continuous joint once round."""
    if not given.whole:
        return Region.working(kinematics, half_width=given.half_width)
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
