"""Mutations of documents, texts, bytes and arguments, all from a seeded generator."""

from __future__ import annotations

import copy
import json
import math
import random
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

NAMES = (
    "",
    " ",
    "../../escape",
    "/etc/passwd",
    "a\x00b",
    "con",
    ".",
    "..",
    "x" * 5000,
    "<script>alert(1)</script>",
    '"; system("touch pwned"); //',
    "*/ int evil(void) { return 1; } /*",
    "$(touch pwned)",
    "`touch pwned`",
    "%s%n%n",
    "{0.__class__}",
    "$\\frac{",
    "ü→机",
    "\u202eabc",
    "\ud800",
    "line\nbreak",
    "-rf",
    "'; DROP TABLE rows; --",
)
NUMBERS = (
    math.nan,
    math.inf,
    -math.inf,
    0,
    -0.0,
    -1,
    1,
    1e-320,
    1e-12,
    0.5,
    1e6,
    1e9,
    -1e300,
    1e308,
    10**18,
    2**63,
    10**400,
    -(10**30),
    True,
    3,
)
PIECES = tuple('<>"{[]-=\n\0')
PIECES += ("", "nan", "9" * 400, "é", "&a;", "1e999", "\\", "'")
KINDS: tuple[Callable[[random.Random], Any], ...] = (
    lambda rng: rng.choice(NUMBERS),
    lambda rng: rng.choice(NAMES),
    lambda rng: None,
    lambda rng: [],
    lambda rng: {},
    lambda rng: [rng.choice(NUMBERS) for _ in range(rng.randrange(1, 9))],
    lambda rng: {rng.choice(NAMES): rng.choice(NUMBERS)},
    lambda rng: nested(rng.choice((5, 200, 3000))),
    lambda rng: "1e5",
    lambda rng: [[0.0] * 3] * 3,
)


class Text(str):
    """A subclass of a plain type: to be taken like one, or refused."""


class Real(float):
    """As ``Text``."""


def nested(depth: int) -> Any:
    """A list in a list, ``depth`` times."""
    value: Any = 1.0
    for _ in range(depth):
        value = [value]
    return value


def junk(rng: random.Random) -> Any:
    """A value of any JSON kind."""
    return rng.choice(KINDS)(rng)


def argument(rng: random.Random) -> Any:
    """A value that a Python call may be given: arrays and objects among them."""
    makers: tuple[Callable[[], Any], ...] = (
        lambda: junk(rng),
        lambda: junk(rng),
        lambda: np.array(rng.choice(NUMBERS[:14])),
        lambda: np.full(rng.randrange(0, 8), rng.choice(NUMBERS[:14]), dtype=float),
        lambda: np.full((rng.randrange(0, 4), rng.randrange(0, 4)), math.nan),
        lambda: np.array(["a", "b", "c"]),
        lambda: np.array([1 + 2j, 3j, 0]),
        lambda: np.array([None, 1.0, {}], dtype=object),
        lambda: np.zeros(3, dtype=rng.choice(("int8", "bool", "float16", "M8[s]"))),
        lambda: np.zeros((3, 0)),
        lambda: Text("pa10"),
        lambda: Real(0.25),
        object,
        lambda: print,
        lambda: b"bytes",
        lambda: 1j,
        lambda: (1.0, 2.0, 3.0),
        lambda: {1, 2},
        lambda: np.float32(0.5),
        lambda: np.int64(-3),
        lambda: iter([1.0]),
    )
    return rng.choice(makers)()


def places(value: Any, limit: int = 4000) -> list[tuple[Any, Any]]:
    """(container, key) of the entries of a document."""
    found: list[tuple[Any, Any]] = []
    waiting = [value]
    while waiting and len(found) < limit:
        node = waiting.pop()
        entries: Iterator[tuple[Any, Any]]
        if isinstance(node, dict):
            entries = iter(node.items())
        elif isinstance(node, list):
            entries = enumerate(node)
        else:
            continue
        for key, child in entries:
            found.append((node, key))
            waiting.append(child)
    return found


def document(rng: random.Random, value: Any) -> Any:
    """A copy of a document with one to three entries changed."""
    result = copy.deepcopy(value)
    for _ in range(rng.choice((1, 1, 1, 2, 3))):
        found = places(result)
        if not found:
            return junk(rng)
        # short ways first: half of the time an entry near the top
        node, key = rng.choice(found[:40] if rng.random() < 0.5 else found)
        _change(rng, node, key, found)
    return result


def _copied(value: Any) -> Any:
    """A copy; None for what an earlier change has nested too deep for one."""
    try:
        return copy.deepcopy(value)
    except RecursionError:
        return None


def _change(
    rng: random.Random, node: Any, key: Any, found: list[tuple[Any, Any]]
) -> None:
    what = rng.randrange(8)
    if what == 0:
        del node[key]
    elif what == 1:
        other, there = rng.choice(found)
        node[key] = _copied(other[there])
    elif what == 2 and isinstance(node, list):
        node.insert(key, _copied(node[key]))
    elif what == 2:
        node[rng.choice(NAMES)] = node[key]
    elif what == 3 and isinstance(node[key], float | int):
        node[key] = node[key] * rng.choice((-1, 1e3, 1e-9, 1 + 1e-12, 1e30))
    elif what == 4 and isinstance(node[key], str):
        node[key] = characters(rng, node[key])
    else:
        node[key] = junk(rng)


def characters(rng: random.Random, text: str) -> str:
    """A text with a few characters or lines changed."""
    for _ in range(rng.choice((1, 1, 2, 5))):
        at = rng.randrange(len(text) + 1)
        end = min(len(text), at + rng.choice((0, 1, 3, 40)))
        put = rng.choice((*PIECES, text[at:end] * 2))
        text = text[:at] + put + text[end:]
    return text


def raw(rng: random.Random, data: bytes) -> bytes:
    """Bytes cut off, flipped, repeated or replaced."""
    what = rng.randrange(6)
    if what == 0:
        return data[: rng.randrange(len(data) + 1)]
    if what == 1:
        return data + rng.randbytes(rng.choice((1, 7, 100)))
    if what == 2:
        return rng.randbytes(rng.choice((0, 1, 90, 300)))
    changed = bytearray(data)
    for _ in range(rng.choice((1, 2, 8, 30))):
        if changed:
            at = rng.randrange(min(len(changed), rng.choice((100, 10**9))))
            changed[at] = rng.choice((0, 255, 127, 10, rng.randrange(256)))
    return bytes(changed)


def json_text(value: Any) -> str:
    """JSON; brackets without end for what is nested too deep to be written."""
    try:
        return json.dumps(value)
    except (RecursionError, ValueError):
        return "[" * 100_000


def json_bytes(rng: random.Random, value: Any) -> bytes:
    """A document as JSON, changed as a document, as text or as bytes."""
    what = rng.randrange(5)
    if what <= 2:
        value = document(rng, value)
    text = json_text(value)
    if what == 3:
        text = characters(rng, text)
    data = text.encode("utf-8", "surrogatepass")
    return raw(rng, data) if what == 4 else data
