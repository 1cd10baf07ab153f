"""``rrnn generate``: a scheme's controller as a C package."""

from __future__ import annotations

import argparse
import inspect
from typing import TYPE_CHECKING, Any

from rrnn_opt.cli import named
from rrnn_opt.cli.folders import folder
from rrnn_opt.cli.output import Output, UsageError

if TYPE_CHECKING:
    from rrnn_opt.embedding import Package

HELP = "write a scheme's controller as a C package"
TARGETS = ("host", "cortex-m4f", "cortex-m7")
_SHARE = 0.95
"""Of the longest safe Euler step, where none is given."""


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
    _add_options(parser)


def _add_options(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("--steps", type=int, default=1, metavar="N", help="network steps a call (1)")
    add(
        "--step-size",
        type=float,
        metavar="S",
        help="Euler step, s (default: 0.95 of the longest that is known to be safe)",
    )
    add(
        "--tolerance", type=float, default=0.01, help="KKT residual before the fallback"
    )
    add("--no-fallback", action="store_true", help="leave the exact solver out")
    add("--no-whitening", action="store_true", help="leave the task's rows as they are")
    add("--fused", action="store_true", help="let a*b + c be rounded once")
    add("--trig", choices=("own", "libm"), default="own", help="sine and cosine")
    _add_parts(parser)


def _add_parts(parser: argparse.ArgumentParser) -> None:
    """What the package holds besides the step."""
    add = parser.add_argument
    add("--task", choices=("position", "pose"), help="what of the tip is controlled")
    add("--obstacles", type=int, default=0, metavar="M", help="spheres to keep off")
    add(
        "--points",
        type=int,
        nargs="+",
        metavar="I",
        help="robot spheres that keep off (default: the last of two links)",
    )
    add(
        "--layout",
        nargs="+",
        choices=("arduino", "fmu"),
        default=[],
        help="also as an Arduino library or an FMI 3.0 FMU with sources",
    )
    add(
        "--planner",
        action="store_true",
        help="with rollouts and memory cell, to plan on board",
    )


def run(args: argparse.Namespace, out: Output) -> int:
    """Write the package and name its folder.

    Raises:
        UsageError: ``--task``, and the scheme has one task only.
    """
    target = folder(args.out)
    package = _measured(_package(args), args.target, out)
    written = package.write(target)
    out.document(package.manifest)
    out.say(f"wrote {written}")
    for line in _costs(package.manifest["footprint"]):
        out.say(line)
    out.say(f"next: {written / 'README.md'} (arguments, build, test)")
    return 0


def _package(args: argparse.Namespace) -> Any:
    """The package that the options ask for.

    Raises:
        UsageError: ``--task``, and the scheme has one task only.
    """
    scheme, robot = named.scheme(args.formulation), named.robot(args.robot)
    from rrnn_opt.embedding import generate
    from rrnn_opt.embedding.step_bound import longest_step
    from rrnn_opt.robot import Kinematics

    kin, rule = Kinematics(robot), _rule(args)
    form, row_norm = _with_obstacles(args, kin, scheme(kin, **_task(args, scheme)))
    step, longest = args.step_size, longest_step(rule, form, row_norm)
    if step is None and longest is not None:
        step = float(f"{_SHARE * longest:.3g}")
    return generate(
        rule(form),
        network=rule,
        kinematics=kin,
        row_norm=row_norm,
        prefix=args.prefix or robot.name,
        real=args.real,
        steps=args.steps,
        step_size=step,
        tolerance=args.tolerance,
        fallback=not args.no_fallback,
        fused=args.fused,
        trig=args.trig,
        target=args.target,
        onboard=_onboard(args, kin),
        layout=args.layout,
    )


def _costs(found: dict[str, Any]) -> list[str]:
    """What the controller takes on its board; nothing where it was not measured."""
    if "board" not in found:
        return []
    low, high = found["instructions"]["min"], found["instructions"]["max"]
    count = f"{low}" if low == high else f"{low} to {high}"
    return [
        f"on {found['board']}: {found['flash_bytes']} bytes of flash,"
        f" {found['ram_bytes']} of RAM, {found['stack_bytes']} of stack,"
        f" {count} instructions a step"
        f" ({found['compiler']}, counted in QEMU)"
    ]


def _rule(args: argparse.Namespace) -> Any:
    """The network; its rows whitened where it can and unless it must not."""
    from rrnn_opt.networks import LviPdnn

    if args.network:
        return named.network(args.network)
    return LviPdnn(whiten=not args.no_whitening)


def _task(args: argparse.Namespace, scheme: Any) -> dict[str, str]:
    if args.task is None:
        return {}
    if "task" not in inspect.signature(scheme).parameters:
        raise UsageError(f"--task: '{args.formulation}' has one task only")
    return {"task": args.task}


def _with_obstacles(
    args: argparse.Namespace, kin: Any, form: Any
) -> tuple[Any, float | None]:
    """The scheme with obstacle rows, and a bound of their norm."""
    from rrnn_opt.formulations.known_obstacles import row_bound, with_obstacles

    if args.obstacles == 0:
        return form, None
    points = args.points or _last_points(kin)
    wanted = {"points": points, "obstacles": args.obstacles}
    return with_obstacles(form, kin, **wanted), row_bound(kin, **wanted)


def _onboard(args: argparse.Namespace, kin: Any) -> Any:
    """The planning module, if it is asked for; one obstacle at least."""
    if not args.planner:
        return None
    from rrnn_opt.embedding.onboard import Onboard

    points = args.points or _last_points(kin)
    return Onboard(kin, points, obstacles=max(args.obstacles, 1))


def _last_points(kin: Any) -> list[int]:
    """The last sphere on each of the last two links that have some."""
    last = {sphere.joint: i for i, sphere in enumerate(kin.robot.spheres)}
    return [last[joint] for joint in sorted(last)[-2:]]


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
