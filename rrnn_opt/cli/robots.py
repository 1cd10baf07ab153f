"""``rrnn robots``: robots, built in or read from a URDF, limits, sources, licences."""

from __future__ import annotations

import argparse
import math
from typing import Any

from rrnn_opt.cli import named
from rrnn_opt.cli.output import Output

HELP = "list the built-in robots, or tell what is read from a URDF"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's arguments."""
    parser.add_argument("name", nargs="*", help="only these; URDF files too")


def run(args: argparse.Namespace, out: Output) -> int:
    """Print one block a robot."""
    from rrnn_opt.robot.builtin import BUILTIN

    found = [described(named.robot(name)) for name in args.name or BUILTIN]
    out.document({"robots": found})
    for facts in found:
        out.say(_block(facts) + "\n")
    return 0


def described(robot: Any) -> dict[str, Any]:
    """Facts about a robot as plain data; no limit is null."""
    inflation = robot.cover.get("inflation_m")
    limits = robot.limits
    return {
        "name": robot.name,
        "dof": robot.nv,
        "frames": [frame.name for frame in robot.frames],
        "tip": robot.tip,
        "spheres": len(robot.spheres),
        "inflation_m": None if inflation is None else list(inflation),
        "joints": list(robot.joint_names),
        "limits": {
            name: [x if math.isfinite(x) else None for x in getattr(limits, name)]
            for name in ("lower", "upper", "velocity", "acceleration")
        },
        "source": robot.source,
        "licence": robot.licence,
    }


def _block(robot: dict[str, Any]) -> str:
    from rrnn_opt.report import table

    head = f"{robot['name']}: {robot['dof']} DoF, tip {robot['tip']}"
    lines = [
        head,
        f"  frames   {', '.join(robot['frames'])}",
        f"  spheres  {robot['spheres']}{_inflation(robot['inflation_m'])}",
        f"  source   {robot['source']}",
        f"  licence  {robot['licence'] or 'not stated'}",
    ]
    names = ("lower", "upper", "velocity", "acceleration")
    rows = list(zip(robot["joints"], *(robot["limits"][n] for n in names), strict=True))
    header = ("joint", "from", "to", "speed", "acceleration")
    return "\n".join([*lines, table(header, rows, indent=2)])


def _inflation(span: list[float] | None) -> str:
    """How much larger the spheres are than the capsules that they cover."""
    if span is None:
        return ""
    low, high = (1e3 * x for x in span)
    return f", larger than what they cover by {low:.2f} to {high:.2f} mm"
