"""One generated input: what it was given to, and how that ended."""

from __future__ import annotations

import gc
import hashlib
import random
import shutil
import signal
import traceback
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rrnn_opt.cli.folders import os_sentence
from rrnn_opt.errors import RrnnError

REFUSED, ACCEPTED = "refused", "accepted"
BAD = (
    "untrue",
    "traceback",
    "poor sentence",
    "hang",
    "wrong exit",
    "lost file",
    "crash",
)
"""untrue: accepted, and not valid; poor sentence: no one-line reason."""
CPU_LIMIT_S = 20.0
LONGEST_SENTENCE = 1500

Attempt = Callable[[random.Random, Path], str]


class UntrueError(Exception):
    """Something was accepted that is not valid."""

    kind = "untrue"


class WrongExitError(Exception):
    """A command ended with another status than its documents promise."""

    kind = "wrong exit"


class LostFileError(Exception):
    """A file outside of what was named is gone or altered."""

    kind = "lost file"


class HangError(BaseException):
    """More processor time than an answer may take."""


@dataclass(frozen=True)
class Entry:
    """Something that takes input.

    Attributes:
        name: for the table.
        attempt: makes an input of a generator and hands it over in an empty
            folder; returns ``ACCEPTED`` or ``REFUSED``, raises what came.
        share: of all inputs, as a weight.
    """

    name: str
    attempt: Attempt
    share: int = 1


@dataclass(frozen=True)
class Ending:
    """How an input ended.

    Attributes:
        kind: ``REFUSED``, ``ACCEPTED`` or one of ``BAD``.
        text: the sentence, or the last lines of the traceback.
    """

    kind: str
    text: str = ""


def require(condition: Any, what: str) -> None:
    """An accepted input must be like this.

    Raises:
        UntrueError: it is not.
    """
    if not condition:
        raise UntrueError(what)


def judged(entry: Entry, number: int, room: Path) -> Ending:
    """Give input ``number`` to an entry; ``room`` is a folder for its files."""
    rng = random.Random(f"{entry.name}/{number}")
    folder = room / "at"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    with guarded(room / "elsewhere") as intact:
        ending = _ended(entry, rng, folder)
        lost = intact()
    return Ending("lost file", lost) if lost else ending


@contextmanager
def guarded(elsewhere: Path) -> Iterator[Callable[[], str]]:
    """A folder that no input may touch; the answer names what was."""
    if not elsewhere.exists():
        (elsewhere / "inner").mkdir(parents=True)
        for name in ("precious.txt", "plan.json", "journal.jsonl", "inner/kept.c"):
            (elsewhere / name).write_text(f"{name}\nkeep me", encoding="utf-8")
    before = _digest(elsewhere)

    def intact() -> str:
        if _digest(elsewhere) == before:
            return ""
        shutil.rmtree(elsewhere)
        return "a file in another folder was changed"

    yield intact


def _digest(folder: Path) -> str:
    files = sorted(p for p in folder.rglob("*") if p.is_file())
    parts = [f"{p.relative_to(folder)}\0".encode() + p.read_bytes() for p in files]
    return hashlib.sha256(b"\0\0".join(parts)).hexdigest()


def _ended(entry: Entry, rng: random.Random, folder: Path) -> Ending:
    try:
        with limited(), warnings.catch_warnings():
            warnings.simplefilter("error")
            warnings.simplefilter("ignore", ResourceWarning)
            warnings.simplefilter("ignore", DeprecationWarning)
            return Ending(entry.attempt(rng, folder))
    except RrnnError as error:
        return _sentence(str(error))
    except OSError as error:
        return _sentence(os_sentence(error))
    except HangError:
        return Ending("hang", f"more than {CPU_LIMIT_S} s")
    except (UntrueError, WrongExitError, LostFileError) as error:
        return Ending(error.kind, str(error))
    except BaseException as error:
        if isinstance(error, KeyboardInterrupt):
            raise
        lines = traceback.format_exception(error)
        return Ending("traceback", "".join(lines)[-1500:])
    finally:
        gc.collect(0)


def _sentence(text: str) -> Ending:
    good = text.strip() and len(text) <= LONGEST_SENTENCE and "\n" not in text.strip()
    return Ending(REFUSED if good else "poor sentence", text[:300])


@contextmanager
def limited(seconds: float = CPU_LIMIT_S) -> Iterator[None]:
    """Raise ``HangError`` when the processor time is spent."""

    def ring(*_: object) -> None:
        raise HangError

    before = signal.signal(signal.SIGPROF, ring)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)
