"""Sine and cosine with a proved error, from IEEE arithmetic alone.

What a library's sin and cos are off by is nowhere promised, so proofs use
these.  Only ``+ - *`` and ``rint`` occur; u = 2^-53.

Reduction: ``x = k pi/2 + r`` with k the integer nearest to ``fl(2 x / pi)``.
pi/2 = P1 + P2 + P3 + rest, the first two of 33 bits, |rest| < 2^-120.  For
|x| <= 1e6, |k| < 2^20, so k P1 and k P2 are exact, and |r| <= 0.7855.  Each of
the three subtractions rounds by u |result| <= 0.786 u; k P3 and k rest are
below 3e-15 u' relative terms, together less than 0.01 u.  Hence |error of r|
<= 2.4 u, and sine and cosine change by no more.

Kernels: Taylor's polynomials up to r^17 and r^16.  By Taylor's theorem the
remainders are at most 0.7855^19 / 19! < 1e-19 and 0.7855^18 / 18! < 3e-18, less
than 0.03 u.  sin = r + r (z S(z)) with |z S| < 0.11 rounds by less than 1.6 u,
cos = 1 + z C(z) with |z C| < 0.31 by less than 2.2 u (Horner's rule: at most
two roundings a step, each step's value at most half of the next one's).

Together less than 5 u each; ``ERROR`` = 8 u is what proofs use.  The tests hold
it to ball arithmetic on a fine grid of the reduced range and at random
arguments up to the limit.
"""

from __future__ import annotations

from math import factorial
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

LARGEST = 1e6
"""Beyond this, rad, the answer is NaN, which proves nothing."""
ERROR = 8 * 2.0**-53

_P1 = float.fromhex("0x1.921fb544p+0")
_P2 = float.fromhex("0x1.0b4611a6p-34")
_P3 = float.fromhex("0x1.3198a2e037073p-69")
_SINE = [(-1.0) ** k / factorial(2 * k + 1) for k in range(8, 0, -1)]
_COSINE = [(-1.0) ** k / factorial(2 * k) for k in range(8, 0, -1)]


def sincos(x: Any) -> tuple[Array, Array]:
    """Sine and cosine, each within ``ERROR``; NaN beyond ``LARGEST``.

    Args:
        x: any shape, rad.
    """
    x = np.asarray(x, dtype=np.float64)
    with np.errstate(all="ignore"):
        x = np.where(np.abs(x) <= LARGEST, x, np.nan)
        k = np.rint(x * (2 / np.pi))
        r = ((x - k * _P1) - k * _P2) - k * _P3
        z = r * r
        s, c = r + r * (z * _horner(_SINE, z)), 1.0 + z * _horner(_COSINE, z)
        quarter = np.where(np.isfinite(k), k, 0.0).astype(np.int64)
    swap = (quarter & 1).astype(bool)
    sine, cosine = np.where(swap, c, s), np.where(swap, s, c)
    return (
        np.where(quarter & 2, -sine, sine),
        np.where((quarter + 1) & 2, -cosine, cosine),
    )


def _horner(coefficients: list[float], z: Array) -> Array:
    value = np.full_like(z, coefficients[0])
    for a in coefficients[1:]:
        value *= z
        value += a
    return value
