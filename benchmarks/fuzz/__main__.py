"""Give bad input to every entry, and count how each ends.

    python -m benchmarks.fuzz [--inputs N] [--jobs J] [--out DIR] [--only WORD]

Input k of an entry depends on nothing but its name and k.  Inputs run in worker
processes, so that a crash costs one input; each answer is one line in DIR, and a
run that is stopped goes on where it ended.  ``--show ENTRY K`` repeats one.
Nothing bad may be among the endings: the exit status is 1 when something is.
"""

from __future__ import annotations

import argparse
import collections
import json
import resource
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from benchmarks.fuzz.entries import ENTRIES
from benchmarks.fuzz.judging import ACCEPTED, BAD, REFUSED, Entry, judged
from rrnn_opt.validation.ending import ended

RESULTS = Path(__file__).parents[2] / "runs" / "fuzz"
INPUTS = 24_000
BATCH = 250
PATIENCE_S = 900.0
MEMORY = 8 * 2**30
"""Address space of a worker, bytes."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run what is left, then print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--inputs", type=int, default=INPUTS)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--out", type=Path, default=RESULTS)
    parser.add_argument("--only", default="", help="entries whose name has this")
    parser.add_argument("--show", nargs=2, metavar=("ENTRY", "K"))
    parser.add_argument("--worker", nargs=3, help=argparse.SUPPRESS)
    args = parser.parse_args(argv)
    if args.worker is not None:
        return _work(args.worker[0], int(args.worker[1]), int(args.worker[2]))
    if args.show is not None:
        with tempfile.TemporaryDirectory() as room:
            ending = judged(_named(args.show[0]), int(args.show[1]), Path(room))
        print(ending.kind, ending.text, sep="\n")
        return 0
    args.out.mkdir(parents=True, exist_ok=True)
    chosen = [entry for entry in ENTRIES if args.only in entry.name]
    with ThreadPoolExecutor(args.jobs) as pool:
        list(pool.map(lambda job: _batch(*job, args.out), _jobs(chosen, args.inputs)))
    print(table(chosen, args.out))
    return 1 if any(_bad(entry, args.out) for entry in chosen) else 0


def counts(inputs: int) -> dict[str, int]:
    """Inputs of every entry, of so many in all."""
    whole = sum(entry.share for entry in ENTRIES)
    return {entry.name: -(-inputs * entry.share // whole) for entry in ENTRIES}


def _jobs(entries: Iterable[Entry], inputs: int) -> list[tuple[str, int, int]]:
    wanted = counts(inputs)
    return [
        (entry.name, begin, min(begin + BATCH, wanted[entry.name]))
        for entry in entries
        for begin in range(0, wanted[entry.name], BATCH)
    ]


def _named(name: str) -> Entry:
    return next(entry for entry in ENTRIES if entry.name == name)


def _work(name: str, begin: int, end: int) -> int:
    """Answer inputs, one line each; a line before each says that it begins."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    entry = _named(name)
    with tempfile.TemporaryDirectory() as room:
        for number in range(begin, end):
            print(json.dumps([number]), flush=True)
            ending = judged(entry, number, Path(room))
            print(json.dumps([number, ending.kind, ending.text]), flush=True)
    return 0


def _batch(name: str, begin: int, end: int, out: Path) -> None:
    """Run a batch in processes until every input has an ending."""
    file = out / f"{name}-{begin:06d}-{end:06d}.jsonl"
    while (number := _next(file, begin)) < end:
        words = [sys.executable, "-m", "benchmarks.fuzz", "--worker"]
        command = [*words, name, str(number), str(end)]
        with file.open("a", encoding="utf-8") as log:
            try:
                done = subprocess.run(
                    command,
                    stdout=log,
                    stderr=subprocess.DEVNULL,
                    timeout=PATIENCE_S,
                    check=False,
                )
                word = f"exit status {done.returncode}"
                kind = "crash"
            except subprocess.TimeoutExpired:
                word, kind = f"more than {PATIENCE_S} s", "hang"
        started = _next(file, begin)
        if started < end:
            with file.open("a", encoding="utf-8") as log:
                log.write(json.dumps([started, kind, word]) + "\n")


def _lines(file: Path) -> dict[int, tuple[str, str]]:
    found = {}
    if file.exists():
        for line in file.read_text(encoding="utf-8").splitlines():
            try:
                words = json.loads(line)
                found[words[0]] = (words[1], words[2])
            except (ValueError, IndexError, TypeError):
                continue  # a beginning, or a line cut off
    return found


def _next(file: Path, begin: int) -> int:
    found = _lines(file)
    return next(k for k in range(begin, begin + len(found) + 1) if k not in found)


def _endings(entry: Entry, out: Path) -> dict[int, tuple[str, str]]:
    found: dict[int, tuple[str, str]] = {}
    for file in sorted(out.glob(f"{entry.name}-*.jsonl")):
        found |= _lines(file)
    return found


def _bad(entry: Entry, out: Path) -> bool:
    return any(kind in BAD for kind, _ in _endings(entry, out).values())


def table(entries: Sequence[Entry], out: Path) -> str:
    """Counts of endings by entry, as Markdown."""
    kinds = (REFUSED, ACCEPTED, *BAD)
    rows = [("entry", "inputs", *kinds)]
    total: collections.Counter[str] = collections.Counter()
    for entry in entries:
        found = collections.Counter(kind for kind, _ in _endings(entry, out).values())
        total += found
        numbers = [found.total(), *(found[kind] for kind in kinds)]
        rows.append((entry.name, *map(str, numbers)))
    rows.append(("all", *map(str, [total.total(), *(total[k] for k in kinds)])))
    lines = ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join([lines[0], "|---" * len(rows[0]) + "|", *lines[1:]])


if __name__ == "__main__":
    sys.exit(ended(main))
