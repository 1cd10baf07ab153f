"""``rrnn simulate``: closed-loop tracking of a curve with one scheme."""

from __future__ import annotations

import argparse
import io
import json
from dataclasses import replace
from pathlib import Path
from typing import Any

from rrnn_opt.cli import named
from rrnn_opt.cli.arguments import not_negative, seed
from rrnn_opt.cli.folders import folder
from rrnn_opt.cli.output import Output

FILES = ("simulation.csv", "simulation.png", "metrics.json")
HELP = "track a curve in closed loop with one scheme"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's arguments."""
    parser.add_argument("formulation", metavar="FORMULATION", help="name of a scheme")
    parser.add_argument("--robot", required=True, help="built-in name or URDF file")
    parser.add_argument("--task", required=True, metavar="TASK.toml", help="the task")
    parser.add_argument(
        "--noise",
        type=not_negative,
        metavar="SIGMA",
        help="standard deviation, in place of the task's",
    )
    parser.add_argument(
        "--seed", type=seed, help="of the noise, in place of the task's"
    )
    parser.add_argument(
        "--network",
        metavar="NAME",
        help="that settles the scheme (default: PrimalDual with the task's epsilon)",
    )
    parser.add_argument("--out", metavar="DIR", help="write CSV, picture and metrics")


def run(args: argparse.Namespace, out: Output) -> int:
    """0 when the limits were kept, else 1."""
    target = folder(args.out) if args.out is not None else None
    scheme, robot = named.scheme(args.formulation), named.robot(args.robot)
    network = named.network(args.network) if args.network else None
    from rrnn_opt.report import table
    from rrnn_opt.simulation import Task, simulate

    task = Task.load(args.task)
    noise = task.noise
    if args.noise is not None:
        noise = replace(noise, sigma=args.noise)
    if args.seed is not None:
        noise = replace(noise, seed=args.seed)
    result = simulate(scheme, robot, replace(task, noise=noise), network=network)
    paths = [target / name for name in FILES] if target is not None else []
    document = result.to_dict(paths)
    out.document(document)
    out.say(table(("", args.formulation), _rows(document), indent=2))
    if target is not None:
        _write(result, document, target)
    for path in paths:
        out.say(f"wrote {path}")
    return 0 if document["limits_kept"] else 1


def _rows(document: dict[str, Any]) -> list[tuple[str, str]]:
    return [
        (key.replace("_", " "), f"{value:.6g}" if isinstance(value, float) else value)
        for key, value in document.items()
        if key != "files"
    ]


def _write(result: Any, document: dict[str, Any], target: Path) -> None:
    """CSV, picture and metrics; each appears whole or not at all."""
    from rrnn_opt.report import draw_tracking, write_bytes, write_text

    table, picture, metrics = (target / name for name in FILES)
    write_text(table, result.to_csv())
    image = io.BytesIO()
    draw_tracking(
        image,
        t=result.t,
        reference=result.reference,
        tip=result.tip,
        share=result.qd / result.robot.limits.velocity,
        title=f"{result.scheme} on {result.robot.name}",
    )
    write_bytes(picture, image.getvalue())
    write_text(metrics, json.dumps(document, indent=1, allow_nan=False) + "\n")
