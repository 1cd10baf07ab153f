"""Measure all of ``ratios``, or those named: python -m benchmarks [NAME ...]."""

from __future__ import annotations

import argparse
import importlib
import sys

from benchmarks.record import Benchmark
from rrnn_opt.validation.ending import ended

NAMES = (
    "kinematics",
    "batch",
    "control_step",
    "planning",
    "command",
    "whitening",
    "simulation",
    "intervals",
    "study",
)


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument("names", nargs="*", help=f"of {', '.join(NAMES)}; all if none")
    wanted = parser.parse_args().names or NAMES
    unknown = [name for name in wanted if name not in NAMES]
    if unknown:
        parser.error(f"no benchmark '{unknown[0]}'; there are {', '.join(NAMES)}")
    failed = 0
    for name in wanted:
        failed += not measure(name)
    return 1 if failed else 0


def measure(name: str) -> bool:
    """Run one benchmark, write its files and print its table."""
    try:
        module = importlib.import_module(f"benchmarks.ratios.{name}")
        benchmark = Benchmark(name, (module.__doc__ or "").strip())
        module.run(benchmark)
    except ImportError as error:
        print(f"{name}: left out, {error}", file=sys.stderr)
        return False
    print(benchmark.markdown())
    print(f"written: {benchmark.write()}")
    return True


if __name__ == "__main__":
    sys.exit(ended(main))
