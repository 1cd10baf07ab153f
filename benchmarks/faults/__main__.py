"""End commands at seeded random moments, and look at what they leave.

    python -m benchmarks.faults [--kills N] [--seed S] [--only WORD] [--page]

Four commands (a first plan, which compiles; a plan over the files of another; a
study that is resumed; a package over another) are each ended N times by SIGKILL, by
SIGTERM and by Ctrl-C, at moments drawn from the time that they take.  Afterwards no
visible file may be torn, no finished row gone, no package mixed; a process that was
asked to end says so in one sentence and ends in time; and the command, run again,
gives what it gives in an empty folder.
"""

from __future__ import annotations

import argparse
import collections
import hashlib
import json
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from benchmarks.faults.page import BAD, page
from benchmarks.faults.place import PROBLEM, Place, contents, furnished, whole
from rrnn_opt.report import write_text
from rrnn_opt.validation.ending import ended

PAGE = Path(__file__).parents[2] / "docs" / "results" / "faults.md"
CLI = "rrnn_opt.cli.start"
PLAN = ("plan", "problem.json", "--out", "out", "--json")
STUDY = ("reproduce", "fig3", "--trials", "2", "--jobs", "1", "--out", "out")
STUDY += ("--resume", "--json")
PACKAGE = ("generate", "minimum_velocity", "--robot", "planar3", "--out", "out")
WAYS = {"SIGKILL": signal.SIGKILL, "SIGTERM": signal.SIGTERM, "Ctrl-C": signal.SIGINT}
LATEST = 1.05
"""Of the time that a command takes: the last moment at which one is ended."""
PATIENCE_S = 60.0
AGAIN = 5
"""After every so many moments the command is run again, to its end."""


@dataclass(frozen=True)
class Command:
    """A command to be ended.

    Attributes:
        words: of ``rrnn``.
        before: what is done in its folder first.
        cold: whether it finds an empty cache, which it shares with the others.
        kept: whether it goes on in the folder of the one before.
    """

    words: tuple[str, ...]
    before: Callable[[Place], None] = lambda place: None
    cold: bool = False
    kept: bool = False


def another_plan(place: Place) -> None:
    """Files of a plan to another goal."""
    problem = PROBLEM | {"goal": {"joints": [-0.5, 0.3, 0.8]}}
    given = (place.path / "problem.json").read_text(encoding="utf-8")
    (place.path / "problem.json").write_text(json.dumps(problem), encoding="utf-8")
    place.rrnn(*PLAN)
    (place.path / "problem.json").write_text(given, encoding="utf-8")


def another_package(place: Place) -> None:
    """A package of other files under the same name."""
    place.rrnn(*PACKAGE, "--real", "double", "--no-fallback", "--layout", "arduino")


COMMANDS = {
    "first plan": Command(PLAN, cold=True),
    "plan over another": Command(PLAN, another_plan),
    "study": Command(STUDY, kept=True),
    "package over another": Command(PACKAGE, another_package),
}


def rows_of(folder: Path) -> int:
    """Whole rows in all journals and parts."""
    if any(folder.rglob("part-*.parquet")):
        return 10**9
    texts = (p.read_bytes() for p in folder.rglob("journal.jsonl"))
    return sum(text.count(b"\n") for text in texts)


def mixed(folder: Path) -> bool:
    """Whether a package that has a manifest holds other files than it lists."""
    manifest = folder / "planar3" / "MANIFEST.json"
    if not manifest.exists():
        return False
    files = json.loads(manifest.read_text(encoding="utf-8"))["files"]
    return any(
        hashlib.sha256((manifest.parent / name).read_bytes()).hexdigest() != digest
        for name, digest in files.items()
    )


def answer(process: subprocess.Popen[str], way: str) -> str:
    """How a process ended that was asked to by a signal."""
    try:
        _, said = process.communicate(timeout=PATIENCE_S)
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
        return "hang"
    code = process.returncode
    if code == 0:
        return "finished"
    if code == -WAYS[way]:
        return "ended there" if way == "SIGKILL" else "ended before"
    if way == "SIGKILL" or code != 128 + WAYS[way]:
        print(f"exit status {code}", said, file=sys.stderr)
        return "wrong status"
    lines = [line for line in said.splitlines() if "interrupted" in line]
    if "Traceback" in said or len(lines) != 1:
        print(said, file=sys.stderr)
        return "poor sentence"
    return "ended there"


def left(place: Place, rows: int) -> str:
    """What is wrong with the files that a command left; empty when nothing is."""
    seen = (p for p in place.files() if not any(q[0] == "." for q in p.split("/")))
    if not all(whole(place.out / name) for name in seen):
        return "torn file"
    if rows_of(place.out) < rows:
        return "lost row"
    return "mixed package" if mixed(place.out) else ""


@dataclass
class Trial:
    """All moments of one command and one way to end it."""

    command: Command
    way: str
    room: Path
    warm: Path

    def run(self, kills: int, rng: random.Random) -> collections.Counter[str]:
        """Counts of how it ended and what was wrong."""
        cache = self.room / "cache" if self.command.cold else self.warm
        if not self.command.cold:  # timed with everything compiled, as it will run
            furnished(self.room / "first", self.warm).rrnn(*self.command.words)
        own = self.room / "own" if self.command.cold else self.warm
        clean = furnished(self.room / "clean", own)
        begin = time.monotonic()
        first = clean.rrnn(*self.command.words)
        spent = time.monotonic() - begin
        if first.returncode != 0:
            raise RuntimeError(first.stderr)
        found: collections.Counter[str] = collections.Counter()
        old = furnished(self.room / "old", self.warm)
        self.command.before(old)
        place = Place(self.room / "kept", cache)
        for k in range(kills):
            if not (self.command.kept and place.path.exists()):
                place = Place(self.room / str(k), cache)
                shutil.copytree(old.path, place.path)
            found[self._once(place, rng.uniform(0.02, LATEST) * spent)] += 1
            if k % AGAIN == AGAIN - 1 or k == kills - 1:
                found["other result"] += not self._same(place, clean)
                shutil.rmtree(place.path)
        return found

    def _once(self, place: Place, moment: float) -> str:
        rows = rows_of(place.out)
        process = place.start(CLI, *self.command.words)
        time.sleep(moment)
        process.send_signal(WAYS[self.way])
        ending = answer(process, self.way)
        return left(place, rows) or ending

    def _same(self, place: Place, clean: Place) -> bool:
        """Whether the command, run again to its end, gives what it always does."""
        place.age()
        again = place.rrnn(*self.command.words)
        if again.returncode != 0 or place.litter():
            print(again.stderr, place.litter(), file=sys.stderr)
            return False
        if self.command.kept:  # its files say how often it was begun
            return rows_of(place.out) == rows_of(clean.out)
        return contents(place) == contents(clean)


def main(argv: Sequence[str] | None = None) -> int:
    """End all commands in all ways; 1 when something was wrong."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, default=20, help="a command and way")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", default="", help="commands whose name has this")
    parser.add_argument("--page", action="store_true", help="write docs/results")
    args = parser.parse_args(argv)
    # a job in the background ignores Ctrl-C, and so would the commands that it starts
    signal.signal(signal.SIGINT, signal.default_int_handler)
    table = {}
    with tempfile.TemporaryDirectory() as name:
        for (title, command), way in (
            (item, way) for item in COMMANDS.items() for way in WAYS
        ):
            if args.only not in title:
                continue
            room = Path(name) / f"{title}-{way}"
            room.mkdir()
            rng = random.Random(f"{args.seed}/{title}/{way}")
            trial = Trial(command, way, room, Path(name) / "warm")
            table[title, way] = trial.run(args.kills, rng)
            print(title, way, dict(table[title, way]), flush=True)
            shutil.rmtree(room)
    said = f"python -m benchmarks.faults --kills {args.kills} --seed {args.seed}"
    said += f" --only {args.only}" if args.only else ""
    text = page(table, said)
    print(text)
    if args.page:
        write_text(PAGE, text)
    return 1 if any(found[kind] for found in table.values() for kind in BAD) else 0


if __name__ == "__main__":
    sys.exit(ended(main))
