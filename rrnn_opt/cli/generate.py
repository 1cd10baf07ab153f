"""``rrnn generate``: a scheme's controller as a C package."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from rrnn_opt.cli import named
from rrnn_opt.cli.folders import folder
from rrnn_opt.cli.output import Output

if TYPE_CHECKING:
    from rrnn_opt.embedding import Package

TARGETS = ("host", "cortex-m4f", "cortex-m7")
HELP = "write a scheme's controller as a C package"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's arguments."""
    parser.add_argument("formulation", metavar="FORMULATION", help="name of a scheme")
    parser.add_argument("--robot", required=True, help="built-in name or URDF file")
    parser.add_argument("--out", required=True, metavar="DIR", help="parent folder")
    parser.add_argument(
        "--network",
        metavar="NAME",
        help="a network by name (default: LviPdnn over whitened rows)",
    )
    parser.add_argument("--real", choices=("float", "double"), default="float")
    parser.add_argument("--prefix", help="of every exported name (default: the robot)")
    parser.add_argument("--target", choices=TARGETS, default="host")


def run(args: argparse.Namespace, out: Output) -> int:
    """Write the package and name its folder."""
    target = folder(args.out)
    scheme, robot = named.scheme(args.formulation), named.robot(args.robot)
    from rrnn_opt.embedding import generate
    from rrnn_opt.networks import LviPdnn
    from rrnn_opt.robot import Kinematics

    rule = named.network(args.network) if args.network else LviPdnn(whiten=True)
    law = rule(scheme(Kinematics(robot)))
    package = generate(
        law, prefix=args.prefix or robot.name, real=args.real, target=args.target
    )
    package = _measured(package, args.target, out)
    written = package.write(target)
    out.document(package.manifest)
    out.say(f"wrote {written}")
    return 0


def _measured(package: Package, target: str, out: Output) -> Package:
    """The package with what it costs on its board, where that can be measured."""
    from rrnn_opt.embedding.target import BOARDS, missing

    if target not in BOARDS:
        return package
    if missing():
        out.say(f"not measured on {target}: apt install {' '.join(missing())}")
        return package
    from rrnn_opt.embedding.target.measure import measured

    return measured(package, BOARDS[target])
