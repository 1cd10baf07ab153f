"""Random graphs, boxes and points: no value may lie outside its enclosure.

``python -m benchmarks.interval_soundness [--cases N]`` goes on from the number
of cases in ``results/interval_soundness.json``.  A case is one random graph
over one random box: its natural and mean-value enclosures by the compiled
kernel, the enclosures of the checker, and the value at a few points of the box
in ball arithmetic of 200 bits, which must overlap every one of them.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path

from benchmarks.interval_soundness.run import BOXES, GRAPHS, batch
from rrnn_opt.report import write_text
from rrnn_opt.validation.ending import ended

RESULT = Path(__file__).parents[1] / "results" / "interval_soundness.json"
CASES = GRAPHS * BOXES


def main() -> int:
    parser = argparse.ArgumentParser(
        "python -m benchmarks.interval_soundness", description=__doc__
    )
    parser.add_argument("--cases", type=int, default=100_000)
    wanted = parser.parse_args().cases
    known = json.loads(RESULT.read_text()) if RESULT.exists() else {}
    cases, outside = known.get("cases", 0), known.get("outside", 0)
    bounded, seconds = known.get("bounded", 0), known.get("cpu_s", 0.0)
    while cases < wanted:
        begin = time.process_time()
        found = batch(cases // CASES)
        cases, outside = cases + CASES, outside + found[0]
        bounded, seconds = bounded + found[1], seconds + time.process_time() - begin
        row = {"cases": cases, "outside": outside, "bounded": bounded, "cpu_s": seconds}
        write_text(RESULT, json.dumps(row, indent=1) + "\n")
    print(RESULT.read_text())
    return 1 if outside else 0


if __name__ == "__main__":
    sys.exit(ended(main))
