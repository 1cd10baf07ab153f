"""Names that a package must not use."""

from __future__ import annotations

import re

from rrnn_opt.emit.c99 import require_identifier
from rrnn_opt.errors import RrnnError

_HEADERS = """
assert complex ctype errno fenv float inttypes iso646 limits locale math setjmp signal
stdarg stdbool stddef stdint stdio stdlib string tgmath time wchar wctype
"""
_CPP_WORDS = """
alignas alignof and asm bool catch class compl concept constexpr decltype delete
explicit export false friend mutable namespace new noexcept not nullptr operator or
private protected public requires template this throw true try typeid typename
using virtual wchar_t xor
"""
_OWN_MEMBERS = ("tick",)

HEADERS = frozenset(re.findall(r"\w+", _HEADERS))
MEMBERS = frozenset((*re.findall(r"\w+", _CPP_WORDS), *_OWN_MEMBERS))


def member(name: str) -> str:
    """A name that a struct member may have in C and in C++."""
    return f"{name}_" if name in MEMBERS else name


def require_prefix(prefix: str) -> str:
    """Return ``prefix`` if files and C names can begin with it.

    Raises:
        RrnnError: they cannot.
    """
    word = prefix if isinstance(prefix, str) else ""
    legal = re.fullmatch(r"[A-Za-z][A-Za-z0-9_]{0,30}", word, re.ASCII)
    if not legal or prefix.lower() in HEADERS:
        raise RrnnError(
            f"prefix {ascii(prefix)[:80]}: use a letter, then up to 30 letters, digits"
            " or underscores, and not the name of a standard header"
        )
    return require_identifier(prefix)
