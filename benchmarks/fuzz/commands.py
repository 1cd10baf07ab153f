"""The command line: options, paths and files that are wrong; exit statuses."""

from __future__ import annotations

import contextlib
import io
import json
import os
import random
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import IO

from benchmarks.fuzz import bases, mutation
from benchmarks.fuzz.judging import ACCEPTED, REFUSED, Entry, WrongExitError

Heard = Callable[[], str]
OURS = "this is a fault of ours"
WORDS = (
    *(name for name in mutation.NAMES if "\x00" not in name),
    *("nan", "inf", "-1", "0", "1e400", "9" * 50, "1_000", "٣", "0x10", "true"),
    *("--json", "--seed", "--out", "--help", "--", "-h", "--version", "--debugx"),
    *("planar3", "pa10", "../elsewhere/precious.txt", "/dev/null", "/proc/self/mem"),
)
BASES: tuple[tuple[str, ...], ...] = (
    ("plan", "problem.json", "--max-explorations", "3", "--time-limit", "0.5"),
    ("plan", "problem.json", "--planner", "paper", "--max-explorations", "1"),
    ("plan", "problem.json", "--max-explorations", "3", "--seed", "1"),
    ("check", "plan.json"),
    ("check", "certificate.json"),
    ("view", "plan.json", "--out", "page.html"),
    ("simulate", "minimum_velocity", "--robot", "planar3", "--task", "task.toml"),
    ("simulate", "nothing", "--robot", "arm.urdf", "--task", "task.toml"),
    ("generate", "minimum_velocity", "--robot", "planar3", "--out", "c"),
    ("generate", "minimum_velocity", "--robot", "none", "--out", "c", "--steps", "0"),
    ("verify", "C39"),
    ("verify", "own_claims.py"),
    ("compare", "own_cases.py", "--solvers", "daqp", "--out", "cmp"),
    ("compare", "--list"),
    ("spheres", "arm.urdf", "--out", "fitted.json"),
    ("reproduce", "table9"),
    ("robots",),
)
SCRIPTS = (
    "",
    "x = ",
    "raise RuntimeError('mine')",
    "import sys; sys.exit(0)",
    "import no_such_module",
    "def claims(): return None\ndef cases(): return None",
    "def claims(): return [1, 'x', None]\ndef cases(): return [1, ('a', 3)]",
    "def claims(): raise KeyError('k')\ndef cases(): raise KeyError('k')",
    "def claims(): return []\ndef cases(): return []",
    "claims = cases = 3",
    "def claims(n): return []\ndef cases(n): return []",
    "def claims():\n  raise SystemExit(0)\ndef cases():\n  raise SystemExit",
    "def claims(): return {'a': 1}\ndef cases(): return {'a': 1}",
    "def claims(): return claims()\ndef cases(): return cases()",
    "\x00",
    "# -*- coding: nothing -*-",
    "import os\ndef cases(): return [('../../x', []), ('<script>', [None])]\n"
    "def claims(): return [os]",
    "import casadi as ca\nfrom rrnn_opt.claim import Claim, Relation\n"
    "from rrnn_opt.symbolic import Symbol\n"
    "def claims():\n  x = ca.SX.sym('x')\n"
    "  return [Claim('../../elsewhere/plan', 's', '<script>alert(1)</script>',\n"
    "    (Symbol('x', x),), Relation(x*x, '>=0'))]\n",
)


def attempt(rng: random.Random, folder: Path) -> str:
    """One command in this process, in an empty folder."""
    lay_out(rng, folder)
    words = line(rng)
    return answered(words, folder)


def lay_out(rng: random.Random, folder: Path) -> None:
    """Files that the commands name; one of them damaged half of the time."""
    bases.lay_out(folder)
    good = {
        "problem.json": json.dumps({**bases.PROBLEM, "goal": bases.PROBLEM["goal"][0]}),
        "plan.json": bases.plan_text(),
        "certificate.json": json.dumps(rng.choice([*bases.certificates().values()])),
        "task.toml": bases.TASK,
    }
    for name, text in good.items():
        if rng.random() < 0.4:
            text = mutation.characters(rng, text)
        (folder / name).write_bytes(text.encode("utf-8", "surrogatepass"))
    for name in ("own_claims.py", "own_cases.py"):
        (folder / name).write_text(rng.choice(SCRIPTS), encoding="utf-8")


def line(rng: random.Random) -> list[str]:
    """A command line: words replaced, removed, repeated, put in."""
    words = list(rng.choice(BASES))
    if rng.random() < 0.25 and "--out" not in words and words[0] in ("verify", "plan"):
        words += ["--out", rng.choice(("out", "task.toml", "{x}", "a\nb", "o/../o"))]
    for _ in range(rng.choice((0, 1, 1, 2))):
        at = rng.randrange(len(words) + 1)
        what = rng.randrange(4)
        if what == 0 and at < len(words):
            words[at] = rng.choice(WORDS)
        elif what == 1 and at < len(words) and len(words) > 1:
            del words[at]
        elif what == 2:
            words.insert(at, rng.choice(WORDS))
        elif at < len(words):
            words[at] = mutation.characters(rng, words[at]).replace("\x00", "")
    if words[0] == "reproduce":
        words += ["--jobs", "0"]  # else it may run for hours
    return [*words, "--json"] if rng.random() < 0.6 else words


def answered(words: list[str], folder: Path) -> str:
    """Run it; the status must fit what was said.

    Raises:
        WrongExitError: it does not.
    """
    from rrnn_opt.cli.main import main

    with _inside(folder), _streams() as (out, err):
        code = main(words)
    said, told = out(), err()
    if OURS in told:
        raise AssertionError(f"{words}: {told[-700:]}")
    if "Traceback" in told:
        raise AssertionError(f"{words}: {told[-900:]}")
    if code not in (0, 1, 2):
        raise WrongExitError(f"{words}: exit status {code}")
    if code == 2 and not told.strip():
        raise WrongExitError(f"{words}: exit status 2 without a sentence")
    if "--json" in words and (code != 2 or said.strip()):
        documents = said.strip().splitlines()
        if len(documents) != 1:
            raise WrongExitError(f"{words}: {len(documents)} documents")
        json.loads(documents[0], parse_constant=_no_constant)
    return REFUSED if code == 2 else ACCEPTED


def _no_constant(word: str) -> float:
    raise WrongExitError(f"{word} in the document")


@contextlib.contextmanager
def _inside(folder: Path) -> Iterator[None]:
    before = os.getcwd()
    os.chdir(folder)
    try:
        yield
    finally:
        os.chdir(before)


@contextlib.contextmanager
def _streams() -> Iterator[tuple[Heard, Heard]]:
    """Both descriptors into files, so that C libraries are heard as well."""
    kept = [os.dup(k) for k in (1, 2)]
    files = [tempfile.TemporaryFile() for _ in kept]  # noqa: SIM115 - closed below
    sys.stdout.flush()
    sys.stderr.flush()
    texts: dict[int, str] = {}
    streams = [_writer(file) for file in files]
    for k, file in enumerate(files):
        os.dup2(file.fileno(), k + 1)
    try:
        with (
            contextlib.redirect_stdout(streams[0]),
            contextlib.redirect_stderr(streams[1]),
        ):
            yield (lambda: texts[0]), (lambda: texts[1])
    finally:
        for k, before in enumerate(kept):
            streams[k].close()
            os.dup2(before, k + 1)
            os.close(before)
            with files[k] as file:
                file.seek(0)
                texts[k] = file.read().decode("utf-8", "replace")


def _writer(file: IO[bytes]) -> io.TextIOWrapper:
    """Text into a file that stays open when the writer is closed."""
    copy = os.fdopen(os.dup(file.fileno()), "wb")
    return io.TextIOWrapper(copy, "utf-8", write_through=True)


ENTRIES = (Entry("command line", attempt, 5),)
