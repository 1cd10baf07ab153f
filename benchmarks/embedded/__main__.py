"""Flash, RAM, stack and instructions of generated controllers beside their peers.

    python -m benchmarks.embedded [--daqp DIR] [--out docs/results/embedded.md]

DIR is a copy of DAQP's sources (github.com/darnstrom/daqp); without it its rows are
left out.  Needs gcc-arm-none-eabi, libnewlib-arm-none-eabi and qemu-system-arm.
"""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
from functools import partial
from pathlib import Path

from benchmarks.embedded import codes, law
from benchmarks.embedded.page import page
from benchmarks.embedded.table import Cost, cost
from rrnn_opt.embedding.target.board import BOARDS, require_tools
from rrnn_opt.validation.ending import ended

OUT = Path(__file__).parents[2] / "docs" / "results" / "embedded.md"
REALS = ("float", "double")


def main() -> int:
    about, _, how = (__doc__ or "").partition("\n\n")
    parser = argparse.ArgumentParser(prog="python -m benchmarks.embedded", usage=how)
    parser.description = about
    parser.add_argument("--daqp", type=Path, metavar="DIR")
    parser.add_argument("--out", type=Path, default=OUT)
    wanted = parser.parse_args()
    require_tools()
    found = [c for maker in makers(wanted.daqp) for c in costs(maker)]
    text = page(found, law.cases(), _commit(wanted.daqp))
    wanted.out.parent.mkdir(parents=True, exist_ok=True)
    wanted.out.write_text(text)
    print(text)
    return 0


def makers(daqp: Path | None) -> list[codes.Maker]:
    found: list[codes.Maker] = [
        partial(codes.ours, whiten=False),
        codes.casadi_output,
        partial(codes.ours, whiten=True),
        partial(codes.package, exact=False),
        partial(codes.package, exact=True),
        codes.osqp_codegen,
    ]
    return found if daqp is None else [*found, partial(codes.daqp_source, tree=daqp)]


def costs(maker: codes.Maker) -> list[Cost]:
    return [cost(maker, real, board) for real in REALS for board in BOARDS.values()]


def _commit(tree: Path | None) -> str:
    if tree is None or shutil.which("git") is None:
        return ""
    command = ["git", "-C", str(tree), "rev-parse", "--short", "HEAD"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done.stdout.strip()


if __name__ == "__main__":
    sys.exit(ended(main))
