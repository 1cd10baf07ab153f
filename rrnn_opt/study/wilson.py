"""Confidence interval of a proportion."""

from __future__ import annotations

from rrnn_opt.arguments import checked
from rrnn_opt.errors import RrnnError


@checked()
def wilson(successes: int, n: int, *, confidence: float = 0.95) -> tuple[float, float]:
    """Wilson's score interval of successes / n.

    Args:
        successes: how many of the n cases succeeded.
        n: number of independent cases; with n = 0 nothing is known.
        confidence: of the two-sided interval.

    Returns:
        Lower and upper limit, both in [0, 1].

    Raises:
        RrnnError: successes is not between 0 and n, or confidence not between 0
            and 1.
    """
    if not 0 <= successes <= n:
        raise RrnnError(f"{successes} successes in {n} cases")
    if not 0.0 < confidence < 1.0:
        raise RrnnError(f"confidence must lie between 0 and 1, not {confidence}")
    if n == 0:
        return 0.0, 1.0
    from scipy.stats import binomtest

    interval = binomtest(successes, n).proportion_ci(confidence, method="wilson")
    return float(interval.low), float(interval.high)
