"""A bound on the stack of a call, from the compiler's own call graph."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from rrnn_opt.errors import RrnnError

FLAG = "-fcallgraph-info=su"
"""Makes gcc write ``NAME.ci`` beside ``NAME.o``."""

_NODE = re.compile(
    r'^node: \{ title: "([^"]+)" label: "[^"]*?(\d+) bytes \((\w+)', re.M
)
_EDGE = re.compile(r'^edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"', re.M)


@dataclass(frozen=True)
class Stack:
    """Stack of one entry point and all that it calls.

    Attributes:
        bytes: along the deepest path, library functions left out.
        library: functions of the C library and of the compiler on some path,
            whose stack the compiler does not tell.
    """

    bytes: int
    library: frozenset[str]


def stack_bound(graphs: Iterable[str], entry: str) -> Stack:
    """Longest path of a call graph, weighed with each function's frame.

    Args:
        graphs: texts of ``.ci`` files.
        entry: function to start from.

    Raises:
        RrnnError: no such function; a frame that is not of fixed size;
            recursion.
    """
    frames: dict[str, int] = {}
    calls: dict[str, set[str]] = {}
    for text in graphs:
        for name, size, kind in _NODE.findall(text):
            if kind != "static":
                raise RrnnError(f"stack: the frame of '{name}' is {kind}")
            frames[name] = int(size)
        for source, target in _EDGE.findall(text):
            calls.setdefault(source, set()).add(target)
    if entry not in frames:
        raise RrnnError(f"stack: the compiler tells of no function '{entry}'")
    library: set[str] = set()
    return Stack(_deepest(entry, frames, calls, library, ()), frozenset(library))


def _deepest(
    name: str,
    frames: dict[str, int],
    calls: dict[str, set[str]],
    library: set[str],
    path: tuple[str, ...],
) -> int:
    if name in path:
        raise RrnnError(f"stack: '{name}' calls itself, so it has no bound")
    if name not in frames:
        library.add(name)
        return 0
    below = (
        _deepest(target, frames, calls, library, (*path, name))
        for target in sorted(calls.get(name, ()))
    )
    return frames[name] + max(below, default=0)
