"""Figures to bytes, whatever the names in them are written in."""

from __future__ import annotations

import warnings
from typing import Any


def save(figure: Any, file: Any, **how: Any) -> None:
    """``figure.savefig``; letters that the font lacks become boxes without a word.

    Args:
        figure: of matplotlib.
        file: path or open file.
        how: arguments of ``savefig``.
    """
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph .* missing from")
        figure.savefig(file, **how)


def drawable(value: object, longest: int = 60) -> str:
    """A short text that a font can draw: halves of characters become ``?``."""
    return str(value)[:longest].encode("utf-8", "replace").decode()
