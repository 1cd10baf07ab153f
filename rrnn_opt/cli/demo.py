"""``rrnn demo``: the main job on the PA10 in front of a window."""

from __future__ import annotations

import argparse
import os
import shlex
import shutil
import sys
from pathlib import Path

from rrnn_opt.cli.arguments import seed
from rrnn_opt.cli.folders import folder
from rrnn_opt.cli.output import Output

HELP = "plan, retime, prove, compare and report: a PA10 reaches through a window"
OUT = "runs/demo"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's arguments."""
    parser.add_argument("--out", metavar="DIR", default=OUT, help="default %(default)s")
    parser.add_argument("--seed", type=seed, default=0, help="default 0")


def run(args: argparse.Namespace, out: Output) -> int:
    """0 when every check passes, else 1."""
    target = folder(args.out)
    from rrnn_opt import demo
    from rrnn_opt.report import table

    report = demo.run(target, seed=args.seed, say=out.note)
    out.document(report.to_dict())
    out.say(table(("what", "found"), report.rows) + "\n")
    for check in report.checks:
        word = "PASS" if check.passed else "FAIL"
        out.say(f"{word}  {check.name}: {check.value} (wanted {check.wanted})")
    for path in report.files:
        out.say(f"wrote {path}")
    out.say(f"\n{report.seconds:.1f} s." + ("  Next:" if report.files else ""))
    for line in following(str(target)) if report.files else ():
        out.say(f"  {line}")
    return 0 if report.passed else 1


def following(target: str) -> tuple[str, str, str]:
    """The next three commands to try, as they can be typed here."""
    rrnn, plan = _called(), shlex.quote(f"{target}/plan.json")
    return f"{rrnn} check {plan}", f"{rrnn} view {plan}", f"{rrnn} robots"


def _called() -> str:
    """How to call ``rrnn`` from this folder and shell."""
    beside = Path(sys.executable).with_name("rrnn")
    if shutil.which("rrnn") or not beside.exists():
        return "rrnn"
    return shlex.quote(os.path.relpath(beside))
