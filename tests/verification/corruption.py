"""One random change at a time to a certificate."""

from __future__ import annotations

import copy
import random
import re

_NUMBER = re.compile(r"-?[0-9]+(/[0-9]+)?")
OPS = ("add", "sub", "mul", "neg", "sq", "fmin", "fmax", "sin", "cos", "div")


def leaves(node, path=()):
    """Paths of all numbers and words of a document's claim, payload and witness."""
    if isinstance(node, dict):
        for key, value in node.items():
            yield from leaves(value, (*path, key))
    elif isinstance(node, list):
        for k, value in enumerate(node):
            yield from leaves(value, (*path, k))
    elif isinstance(node, (str, int)):
        yield path, node


def changed(value, rng):
    """One digit, one sign, one operation or one index made another."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, int):
        return value + rng.choice((-1, 1))
    if _NUMBER.fullmatch(value):
        if rng.random() < 0.3 and value != "0":
            return value[1:] if value.startswith("-") else f"-{value}"
        places = [k for k, c in enumerate(value) if c.isdigit()]
        place = rng.choice(places)
        digit = rng.choice([d for d in "123456789" if d != value[place]])
        return value[:place] + digit + value[place + 1 :]
    if value in OPS:
        return rng.choice([op for op in OPS if op != value])
    if value.startswith(("0x", "-0x")):
        return (float.fromhex(value) * 1.5 + 0.25).hex()
    return None


def corruptions(document, count, seed=0):
    """Changed copies; words that are only read by people stay."""
    rng = random.Random(seed)
    claim = {k: v for k, v in document["claim"].items() if k not in _WORDS}
    places = [
        (top, path, value)
        for top, part in (
            ("claim", claim),
            ("payload", document["payload"]),
            ("witness", document["witness"]),
        )
        for path, value in leaves(part)
    ]
    made = 0
    while made < count:
        top, path, value = rng.choice(places)
        new = changed(value, rng)
        if new is None or new == value:
            continue
        broken = copy.deepcopy(document)
        node = broken[top]
        for key in path[:-1]:
            node = node[key]
        node[path[-1]] = new
        made += 1
        yield broken


_WORDS = ("id", "source", "statement", "inputs", "outputs")
