"""The tests that touch C, with every translation unit under address and undefined.

    python -m benchmarks.sanitize [--jobs N] [--out FILE] [ROOM ...]

``CC`` names a compiler that adds ``-fsanitize=address,undefined`` to whatever it is
asked, so that the planner's runtime, simulations, programs, interval kernels and
generated packages are all built with it; the sanitizer's library is preloaded into
Python.  Everything it has to say is collected in files, and every file is a finding.
Leaks are not looked for: Python keeps what it has until the end.  Works with gcc.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import time
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from pathlib import Path

from rrnn_opt.report import write_text
from rrnn_opt.study.environment import commit
from rrnn_opt.validation.ending import ended

HERE = Path(__file__).resolve().parents[1]
WORK = HERE / "runs" / "sanitize"
PAGE = HERE / "docs" / "results" / "sanitizers.md"
TABLE = "tests.xml"
ROOMS = (
    "tests/emit",
    "tests/planning",
    "tests/simulation",
    "tests/solving",
    "tests/embedding",
    "tests/test_interpreters.py",
    "tests/verification/engines",
)
FLAGS = "-O1 -g -fno-omit-frame-pointer -fsanitize=address,undefined"
FLAGS += " -fsanitize-recover=address -fno-sanitize-recover=undefined"
OUT_OF_PLACE = {
    "test_improving_goes_on_until_its_seconds_are_spent": "counts what fits in 0.5 s",
    "test_a_sign_flipped_in_the_formulation_changes_the_plan": "breaks it on purpose",
    "test_only_the_prefixed_functions_are_visible": "the sanitizer adds calls",
    "test_no_library_function_but_sqrt_is_needed": "the sanitizer adds calls",
}
"""Tests that cannot hold under a sanitizer, and why."""
Outcome = dict[str, int]


def compiler() -> Path:
    """A compiler that sanitizes whatever it is asked to compile.

    It is started without the preloaded library, which would only slow it down.
    """
    WORK.mkdir(parents=True, exist_ok=True)
    text = f'#!/bin/sh\nunset LD_PRELOAD\nexec gcc "$@" {FLAGS}\n'
    path = write_text(WORK / "cc-sanitizing", text)
    path.chmod(0o755)
    return path


def environment(reports: Path) -> dict[str, str]:
    """What the tests run in; reports go to files of their own."""
    libraries = [_library("libasan.so"), _library("libstdc++.so")]
    address = f"detect_leaks=0:halt_on_error=0:log_path={reports}/address"
    address += ":alloc_dealloc_mismatch=0:allocator_may_return_null=1"
    return os.environ | {
        "CC": str(compiler()),
        "LD_PRELOAD": ":".join(libraries),
        "ASAN_OPTIONS": address,
        "UBSAN_OPTIONS": f"print_stacktrace=1:log_path={reports}/undefined",
        "RRNN_CACHE_DIR": str(WORK / "cache"),
        "OPENBLAS_NUM_THREADS": "1",
    }


def _library(name: str) -> str:
    words = ["gcc", f"-print-file-name={name}"]
    done = subprocess.run(words, capture_output=True, text=True, check=True)
    return done.stdout.strip()


def run(room: str, jobs: int, slow: bool) -> tuple[Outcome, list[Path]]:
    """Test one room: how its tests ended, and the reports it left."""
    reports = _reports(room)
    reports.mkdir(parents=True, exist_ok=True)
    for old in reports.iterdir():
        old.unlink()
    table = reports / TABLE
    words = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", room]
    words += ["-n", str(jobs), f"--junitxml={table}"]
    words += ["-m", ""] if slow else []
    words += ["-k", " and ".join(f"not {name}" for name in OUT_OF_PLACE)]
    subprocess.run(words, env=environment(reports), cwd=HERE, check=False)
    return found(room)


def _reports(room: str) -> Path:
    return WORK / "reports" / room.replace("/", "-")


def found(room: str) -> tuple[Outcome, list[Path]]:
    """What the last run of a room left."""
    files = sorted(_reports(room).iterdir()) if _reports(room).is_dir() else []
    return _outcome(_reports(room) / TABLE), [p for p in files if p.name != TABLE]


def _outcome(table: Path) -> Outcome:
    """Counts of pytest's own table; a run that never ended counts as one failure."""
    if not table.exists():
        return {"passed": 0, "failed": 1, "skipped": 0}
    suite = ET.parse(table).getroot()[0].attrib
    count = {key: int(suite[key]) for key in ("tests", "failures", "errors", "skipped")}
    failed = count["failures"] + count["errors"]
    passed = count["tests"] - failed - count["skipped"]
    return {"passed": passed, "failed": failed, "skipped": count["skipped"]}


def report(rows: dict[str, tuple[Outcome, list[Path]]], command: str) -> str:
    """The page that is kept."""
    findings = sum(len(files) for _, files in rows.values())
    tests = sum(outcome["passed"] for outcome, _ in rows.values())
    version = _first(["gcc", "--version"])
    lines = [
        "# Under the sanitizers",
        "",
        f"`{command}` on {time.strftime('%Y-%m-%d', time.gmtime())},",
        f"commit {commit() or 'unknown'}, {version},",
        f"`{FLAGS}`.",
        "",
        "Every C text that these tests compile is built with the address and the",
        "undefined-behaviour sanitizer: the planner's runtime, simulations, programs,",
        "interval kernels and generated packages.  A finding is any report of either.",
        "Leaks are not looked for here; `tests/faults/test_memory.py` bounds memory.",
        "",
        f"**{tests} tests passed, {findings} findings.**",
        "",
        "| tests | passed | failed | skipped | findings |",
        "| --- | ---: | ---: | ---: | ---: |",
    ]
    for room, (outcome, files) in rows.items():
        cells = [room, *(str(outcome[k]) for k in ("passed", "failed", "skipped"))]
        lines.append("| " + " | ".join([*cells, str(len(files))]) + " |")
    if OUT_OF_PLACE:
        lines += ["", "Left out:", ""]
        lines += [f"- `{name}`: {why}" for name, why in OUT_OF_PLACE.items()]
    return "\n".join(lines) + "\n"


def _first(words: Sequence[str]) -> str:
    done = subprocess.run(words, capture_output=True, text=True, check=False, cwd=HERE)
    return (done.stdout.splitlines() or ["unknown"])[0]


def main(argv: Sequence[str] | None = None) -> int:
    """Test the rooms; 1 when a test failed or a sanitizer found anything."""
    parser = argparse.ArgumentParser(
        "python -m benchmarks.sanitize", description=__doc__
    )
    parser.add_argument("rooms", nargs="*", default=list(ROOMS))
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--slow", action="store_true", help="slow tests as well")
    parser.add_argument("--table", action="store_true", help="of the last runs")
    parser.add_argument("--out", type=Path, default=PAGE)
    args = parser.parse_args(argv)
    if not args.table:
        for room in args.rooms:
            run(room, args.jobs, args.slow)
    rows = {room: found(room) for room in args.rooms}
    command = "python -m benchmarks.sanitize"
    command += " --slow" * args.slow
    command += "".join(f" {r}" for r in args.rooms) * (args.rooms != list(ROOMS))
    write_text(args.out, report(rows, command))
    bad = [room for room, (o, files) in rows.items() if o["failed"] or files]
    for room in bad:
        print(f"{room}: see {WORK / 'reports'}", file=sys.stderr)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(ended(main))
