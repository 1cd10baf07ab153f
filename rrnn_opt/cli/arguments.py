"""Types of command line arguments: a wrong one is refused with its reason."""

from __future__ import annotations

import argparse
import math


def seconds(text: str) -> float:
    """A positive, finite number of seconds."""
    value = _float(text)
    if not (math.isfinite(value) and value > 0.0):
        raise argparse.ArgumentTypeError(f"'{text}' is not a positive number")
    return value


def not_negative(text: str) -> float:
    """A finite number that is zero or greater."""
    value = _float(text)
    if not (math.isfinite(value) and value >= 0.0):
        raise argparse.ArgumentTypeError(f"'{text}' is not zero or a positive number")
    return value


def count(text: str) -> int:
    """A positive integer."""
    value = _int(text)
    if value < 1:
        raise argparse.ArgumentTypeError(f"'{text}' is not a positive integer")
    return value


def whole(text: str) -> int:
    """An integer, zero or more."""
    value = _int(text)
    if value < 0:
        raise argparse.ArgumentTypeError(f"'{text}' is not an integer, zero or more")
    return value


def seed(text: str) -> int:
    """An integer from 0 to 2**63 - 1."""
    value = _int(text)
    if not 0 <= value < 2**63:
        raise argparse.ArgumentTypeError(
            f"'{text}' is not an integer from 0 to 2**63-1"
        )
    return value


def _float(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' is not a number") from None


def _int(text: str) -> int:
    try:
        return int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' is not an integer") from None
