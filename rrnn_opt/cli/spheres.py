"""``rrnn spheres``: covering collision spheres of a URDF, proved to cover it."""

from __future__ import annotations

import argparse
import json
import math
from pathlib import Path
from typing import Any

from rrnn_opt.cli.arguments import count, seconds, whole
from rrnn_opt.cli.folders import folder
from rrnn_opt.cli.output import Output, UsageError

HELP = "fit collision spheres to a URDF's geometry and prove that they cover it"
INFLATION = 0.02
MOST = 16
EXTRA = 96


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's arguments."""
    parser.add_argument("urdf", metavar="URDF", help="the robot's description")
    parser.add_argument("--out", required=True, metavar="FILE", help="sphere file")
    parser.add_argument("--tip", metavar="FRAME", help="end-effector link")
    parser.add_argument(
        "--inflation",
        type=seconds,
        default=INFLATION,
        metavar="M",
        help="wanted bulge of the spheres, m (default %(default)s)",
    )
    parser.add_argument(
        "--most",
        type=count,
        default=MOST,
        metavar="N",
        help="spheres for each piece of geometry at most (default %(default)s)",
    )
    parser.add_argument(
        "--extra",
        type=whole,
        default=EXTRA,
        metavar="N",
        help="more spheres at most where links pass each other closely"
        " (default %(default)s)",
    )
    parser.add_argument(
        "--package-dir",
        action="append",
        default=[],
        metavar="DIR",
        help="where package:// paths start (may be repeated)",
    )


def run(args: argparse.Namespace, out: Output) -> int:
    """Fit, prove, write; 1 when something is not shown to be covered.

    Raises:
        UsageError: ``--out`` is a folder.
    """
    from rrnn_opt.report import write_text
    from rrnn_opt.robot.fitting.fit import fit_spheres

    target = Path(args.out)
    if target.is_dir():
        raise UsageError(f"{target} is a folder; give --out the name of a file")
    folder(str(target.parent))
    fitted = fit_spheres(
        args.urdf,
        tip=args.tip,
        inflation=args.inflation,
        most=args.most,
        extra=args.extra,
        folders=tuple(Path(folder) for folder in args.package_dir),
    )
    write_text(target, json.dumps(fitted.to_dict(), indent=1) + "\n")
    facts = described(fitted, str(target))
    out.document(facts)
    out.say(_text(facts))
    return 0 if fitted.covered else 1


def described(fitted: Any, path: str) -> dict[str, Any]:
    """Counts and inflations as plain data."""
    links = [
        {
            "link": cover.link,
            "spheres": len(cover.balls),
            "inflation_m": cover.inflation,
            "triangles": cover.triangles,
            "uncovered_triangles": cover.uncovered,
        }
        for cover in fitted.links
    ]
    return {
        "file": path,
        "covered": fitted.covered,
        "spheres": sum(link["spheres"] for link in links),
        "inflation_m": max((link["inflation_m"] for link in links), default=math.nan),
        "self_contact": {
            "postures": fitted.contact.postures,
            "spheres_first": fitted.before.spheres,
            "spheres": fitted.contact.spheres,
            "geometry": fitted.contact.geometry,
        },
        "links": links,
        "disabled_self_collision_pairs": [list(row) for row in fitted.disabled],
        "visual_geometry": list(fitted.visual),
    }


def _text(facts: dict[str, Any]) -> str:
    from rrnn_opt.report import table

    rows = [
        (
            link["link"],
            str(link["spheres"]),
            f"{1e3 * link['inflation_m']:.1f}",
            _triangles(link["triangles"], link["uncovered_triangles"]),
        )
        for link in facts["links"]
    ]
    header = ("link", "spheres", "bulge [mm]", "triangles covered")
    verdict = "cover" if facts["covered"] else "DO NOT cover"
    pairs = len(facts["disabled_self_collision_pairs"])
    several = "pair" if pairs == 1 else "pairs"
    head = f"{facts['spheres']} spheres {verdict} the geometry; {pairs} {several} of"
    head += " links not checked (reasons in the file)"
    touch = facts["self_contact"]
    head += (
        f"\nlinks touch themselves in {touch['postures']} random postures: spheres"
        f" {touch['spheres']:.1%} ({touch['spheres_first']:.1%} before spheres were"
        f" added), geometry {touch['geometry']:.1%}"
    )
    return f"{head}\n{table(header, rows, indent=2)}\nwrote {facts['file']}"


def _triangles(every: int, uncovered: int) -> str:
    """How many are proved to be covered; primitives are covered by construction."""
    return f"{every - uncovered}/{every}" if every else "no mesh"
