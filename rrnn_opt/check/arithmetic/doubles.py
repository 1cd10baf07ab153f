"""What sums and products of doubles can be off by (Higham 2002, section 3.1)."""

U = 2.0**-53
"""Unit roundoff."""
GROW = 1.0 + 1e-12
"""Turns a computed sum of products of numbers >= 0 into an upper bound.

It exceeds 1 + gamma(4096).
"""


def gamma(n: int) -> float:
    """Relative error of n rounded operations at the most, ``n u / (1 - n u)``."""
    return n * U / (1 - n * U)
