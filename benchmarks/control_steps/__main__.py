"""A million random control steps of generated controllers, their monitor on.

    python -m benchmarks.control_steps [--steps N] [--seed S] [--out FILE]

Every case is a scheme, a network, a robot and a type of numbers; its package is
compiled beside ``harness.c``.  Of 96 requests 64 walk slowly (a network can
follow), 16 jump, 16 hold anything: NaN, infinities, denormals, random bytes, angles
beyond all limits.  An output must be finite; where the status is OK and the verdict
does not say that the residual is large, or says that the exact solver answered, it
must lie within the limits of the request, which are emitted apart and in double.
A refused request must leave state and output as they were.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from benchmarks.control_steps.cases import cases
from benchmarks.control_steps.run import run
from benchmarks.control_steps.table import report
from rrnn_opt.report import write_text
from rrnn_opt.validation.ending import ended

PAGE = Path(__file__).parents[2] / "docs" / "results" / "control_steps.md"
STEPS = 1_200_000


def main(argv: Sequence[str] | None = None) -> int:
    """Drive all cases; 1 when a promise was broken."""
    parser = argparse.ArgumentParser(
        "python -m benchmarks.control_steps", description=__doc__
    )
    parser.add_argument("--steps", type=int, default=STEPS)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--out", type=Path, default=PAGE)
    args = parser.parse_args(argv)
    each = -(-args.steps // len(cases()))
    found = {}
    for case in cases():
        found[case] = run(case, each, args.seed)
        print(f"{case}: {found[case]}", flush=True)
    command = f"python -m benchmarks.control_steps --steps {args.steps}"
    write_text(args.out, report(found, f"{command} --seed {args.seed}"))
    return 1 if any(row["broken"] for row in found.values()) else 0


if __name__ == "__main__":
    sys.exit(ended(main))
