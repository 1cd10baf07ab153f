"""Which branches of the readers the generated input and the tests take.

    python -m benchmarks.fuzz.branches [--inputs N] [--out DIR] [--missing]

Branches alone, not statements: the two ways out of every condition and loop.  Each
entry gets its first N inputs, in a process of its own under coverage.py; then the
tests of the readers' rooms run under it.  ``--missing`` names the lines of branches
that neither took.  ``--page`` puts the table into ``docs/results/fuzz.md``.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from benchmarks.fuzz.entries import ENTRIES
from benchmarks.fuzz.pages import BRANCHES, put
from rrnn_opt.study.environment import commit
from rrnn_opt.validation.ending import ended

HERE = Path(__file__).parents[2]
RESULTS = HERE / "runs" / "branches"
READERS = [
    "arguments/kinds",
    "arguments/checked",
    "files",
    "robot/loading/urdf",
    "robot/loading/urdf_shapes",
    "robot/loading/limits",
    "robot/sphere_file",
    "scene/reading",
    "scene/fields",
    "scene/mesh_file",
    "scene/points",
    "planning/problem/problem",
    "planning/problem/goals",
    "planning/problem/attached",
    "simulation/task_file",
    "check/plans/document",
    "check/plans/reading",
    "check/plans/inputs",
    "check/plans/goal",
    "check/plans/robot/model",
    "check/plans/robot/block",
    "check/plans/collision/scene",
    "check/plans/solids/files",
    "check/plans/solids/cloud",
    "check/claims/certificate",
    "check/claims/document",
    "check/claims/graph/tree",
    "report/plan/drawing",
    "report/plan/form",
    "report/plan/page",
    "study/journal",
    "study/lines",
    "study/parts",
    "study/comparison/interchange",
    "embedding/package",
    "embedding/placing",
]
"""Modules that take apart what a user hands over."""
TESTS = [
    "tests/test_arguments.py",
    "tests/test_files.py",
    "tests/robot",
    "tests/scene",
    "tests/fuzz",
    "tests/planning/problem",
    "tests/simulation",
    "tests/check",
    "tests/report",
    "tests/study",
    "tests/embedding/test_package.py",
    "tests/embedding/test_placing.py",
]


@dataclass(frozen=True)
class Count:
    """Branches of a module: how many there are, and lines of those not taken."""

    branches: int
    missing: tuple[tuple[int, int], ...]

    @property
    def share(self) -> float:
        """Taken of all; 1 where there is nothing to choose."""
        return 1.0 - len(self.missing) / self.branches if self.branches else 1.0


def main(argv: Sequence[str] | None = None) -> int:
    """Measure both, then print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--inputs", type=int, default=100, help="of every entry")
    parser.add_argument("--out", type=Path, default=RESULTS)
    parser.add_argument("--only", default="", help="entries whose name has this")
    parser.add_argument("--missing", action="store_true")
    parser.add_argument("--page", action="store_true")
    args = parser.parse_args(argv)
    fuzz, tests = args.out / "fuzz", args.out / "tests"
    for entry in ENTRIES:
        if args.only in entry.name:
            words = ["-m", "benchmarks.fuzz", "--worker", entry.name, "0"]
            _traced([*words, str(args.inputs)], fuzz / entry.name.replace(" ", "_"))
    if not args.only:
        _traced(["-m", "pytest", "-q", "-n", "0", *TESTS], tests / "tests")
    alone = counts([fuzz], args.out / "fuzz.json")
    both = counts([fuzz, tests], args.out / "both.json")
    text = table(alone, both)
    print(text)
    if args.missing:
        for name, count in both.items():
            print(name, *(f"{a}->{b}" for a, b in count.missing))
    if args.page:
        command = f"python -m benchmarks.fuzz.branches --inputs {args.inputs}"
        put(BRANCHES, f"Commit {commit() or 'unknown'}, `{command}`.\n\n{text}")
    return 0


def _traced(words: Sequence[str], data: Path) -> None:
    """Run a program under coverage, its answers aside."""
    data.parent.mkdir(parents=True, exist_ok=True)
    include = ",".join(f"{HERE}/rrnn_opt/{name}.py" for name in READERS)
    command = [sys.executable, "-m", "coverage", "run", "--branch"]
    command += [f"--data-file={data}", f"--include={include}", *words]
    with data.with_suffix(".log").open("w", encoding="utf-8") as log:
        subprocess.run(command, stdout=log, stderr=log, check=False, cwd=HERE)


def counts(folders: Iterable[Path], report: Path) -> dict[str, Count]:
    """Branches of every reader, over all that was measured in some folders."""
    kept = [p for f in folders for p in sorted(f.iterdir()) if not p.suffix]
    merged = report.with_suffix(".coverage")
    call = [sys.executable, "-m", "coverage"]
    combine = ["combine", "--keep", "-q", f"--data-file={merged}", *map(str, kept)]
    write = ["json", "-q", f"--data-file={merged}", "-o", str(report)]
    for words in (combine, write):
        subprocess.run([*call, *words], check=True, cwd=HERE)
    files: dict[str, Any] = json.loads(report.read_text(encoding="utf-8"))["files"]
    return {name: _count(files.get(f"rrnn_opt/{name}.py")) for name in READERS}


def _count(file: dict[str, Any] | None) -> Count:
    if file is None:
        return Count(1, ((0, 0),))
    missing = tuple((a, b) for a, b in file["missing_branches"])
    return Count(file["summary"]["num_branches"], missing)


def table(alone: dict[str, Count], both: dict[str, Count]) -> str:
    """Shares of branches by module, as Markdown."""
    lines = ["| module | branches | bad input alone | with its tests |"]
    lines.append("|---|---:|---:|---:|")
    for name, count in both.items():
        cells = (name, count.branches, f"{alone[name].share:.0%}", f"{count.share:.0%}")
        lines.append("| " + " | ".join(map(str, cells)) + " |")
    cells = ("all", *_sum(alone, both))
    lines.append("| " + " | ".join(map(str, cells)) + " |")
    return "\n".join(lines) + "\n"


def _sum(alone: dict[str, Count], both: dict[str, Count]) -> tuple[int, str, str]:
    whole = sum(count.branches for count in both.values())
    left = [sum(len(c.missing) for c in found.values()) for found in (alone, both)]
    return whole, *(f"{1 - k / whole:.0%}" for k in left)  # type: ignore[return-value]


if __name__ == "__main__":
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    sys.exit(ended(main))
