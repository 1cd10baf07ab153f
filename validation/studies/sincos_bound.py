"""The sine and cosine of interval kernels are within 2^-49: a proof with balls.

``python -m rrnn_opt.validation.studies.sincos_bound [--balls N]`` proves the
bound ``RRNN_SINCOS`` of ``emit/support/interval_sincos.h`` for |x| <= 1e5, in any
rounding mode: every operation is taken to be off by up to 2^-52 of its result.

Reduction.  kd is an integer with |kd - 2 x / pi| <= 1/2 + 4e-11: the product and
the difference before it are off by less than 2e-11 each, and adding 1.5 * 2^52
rounds to an integer.  So |x - kd pi/2| < 0.7854 and |kd| < 2^16; kd P1 and kd P2
are exact, as 33 + 16 bits fit 53.  The three subtractions round by 2^-52 times
0.7855 each; kd times what three parts leave of pi/2 is bounded in balls.

Kernels.  On each ball around a part of [-0.7855, 0.7855] the polynomial's
distance from the function is bounded by Taylor's theorem to order 10 (both have
a Taylor series, computed in balls), and the rounding of Horner's rule by
running error analysis over the ball.  Sine and cosine are 1-Lipschitz, so the
error of the reduced argument carries over as it is.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass
from math import factorial
from typing import Any

import flint

from rrnn_opt.validation.ending import ended

Ball = Any  # flint.arb: python-flint has no usable stubs

LARGEST, REACH = 1e5, 0.7855
STATED = 2.0**-49
UNIT = 2.0**-52
ORDER, BALLS, PRECISION = 10, 256, 160
PARTS = ("0x1.921fb544p+0", "0x1.0b4611a6p-34", "0x1.3198a2e037073p-69")
SINE = [(-1.0) ** k / factorial(2 * k + 1) for k in range(8, 0, -1)]
COSINE = [(-1.0) ** k / factorial(2 * k) for k in range(8, 0, -1)]
"""Coefficients as the header has them, highest first."""


@dataclass(frozen=True)
class SincosBound:
    """What was proved.

    Attributes:
        sine: |computed - sin x|, over all balls.
        cosine: |computed - cos x|.
        balls: how many there were.
    """

    sine: float
    cosine: float
    balls: int

    @property
    def holds(self) -> bool:
        """Whether the stated bound is no less."""
        return max(self.sine, self.cosine) <= STATED


def prove(
    balls: int = BALLS, *, first: int = 0, last: int | None = None
) -> SincosBound:
    """Bound the error on some of the balls that cover the reduced range.

    Args:
        balls: how many cover it.
        first: number of the first one looked at.
        last: number after the last one; by default all.
    """
    last = balls if last is None else last
    with flint.ctx.workprec(PRECISION):
        reduced = reduction_error()
        worst = [flint.arb(0), flint.arb(0)]
        half = flint.arb(REACH) / balls
        for k in range(first, last):
            centre = -flint.arb(REACH) + half * (2 * k + 1)
            for which, found in enumerate(_kernel_errors(centre, half)):
                worst[which] = worst[which].max(found + reduced)
        ends = [float(error.upper()) * (1 + 1e-12) for error in worst]
    return SincosBound(ends[0], ends[1], last - first)


def reduction_error() -> Ball:
    """|computed r - (x - kd pi/2)| for all |x| <= 1e5."""
    turns = flint.arb(LARGEST) * 2 / flint.arb.pi() + 1
    parts = [flint.arb(float.fromhex(part)) for part in PARTS]
    rest = abs(flint.arb.pi() / 2 - sum(parts, flint.arb(0))) * turns
    third = parts[2] * turns
    return 3 * flint.arb(REACH) * UNIT + rest + third * UNIT + flint.arb(2) ** -90


def _kernel_errors(centre: Ball, half: Ball) -> tuple[Ball, Ball]:
    """Errors of both polynomials for arguments in centre +- half."""
    ball = (centre - half).union(centre + half)
    sine = flint.arb_poly([0, 1, *_odd(SINE)])
    cosine = flint.arb_poly([1, 0, *_even(COSINE)])
    first = _distance(sine, 0, centre, half) + _sine_rounding(ball)
    second = _distance(cosine, 1, centre, half) + _cosine_rounding(ball)
    return first, second


def _odd(coefficients: list[float]) -> list[float]:
    """Coefficients of r^2, r^3, .. from those of r^17, r^15, .. r^3."""
    return [x for c in reversed(coefficients) for x in (0.0, c)]


def _even(coefficients: list[float]) -> list[float]:
    """Coefficients of r^2, r^3, .. from those of r^16, r^14, .. r^2."""
    return [x for c in reversed(coefficients) for x in (c, 0.0)]


def _distance(polynomial: Any, shift: int, centre: Ball, half: Ball) -> Ball:
    """|P - f| over centre +- half, f the sine (shift 0) or the cosine (1)."""
    ball = (centre - half).union(centre + half)
    total = flint.arb(0)
    for k in range(ORDER + 1):
        at = ball if k == ORDER else centre
        shifted = polynomial(flint.arb_poly([at, 1]))
        coefficient = shifted[k] - _derivative(at, k + shift) / factorial(k)
        total += abs(coefficient) * half**k
    return total


def _derivative(at: Ball, order: int) -> Ball:
    """Derivative of the sine of this order."""
    value = at.sin() if order % 2 == 0 else at.cos()
    return -value if order % 4 >= 2 else value


Running = tuple[Ball, Ball]
"""A value and a bound of its error."""


def _rounded(value: Ball, passed: Ball) -> Running:
    return value, passed + UNIT * (abs(value) + passed)


def _times(a: Running, b: Running) -> Running:
    passed = a[1] * abs(b[0]) + b[1] * abs(a[0]) + a[1] * b[1]
    return _rounded(a[0] * b[0], passed)


def _plus(a: Running, b: Running) -> Running:
    return _rounded(a[0] + b[0], a[1] + b[1])


def _exact(x: Any) -> Running:
    return flint.arb(x), flint.arb(0)


def _horner(coefficients: list[float], z: Running) -> Running:
    value = _exact(coefficients[0])
    for c in coefficients[1:]:
        value = _plus(_times(value, z), _exact(c))
    return value


def _sine_rounding(ball: Ball) -> Ball:
    r = _exact(ball)
    z = _times(r, r)
    return _plus(r, _times(r, _times(z, _horner(SINE, z))))[1]


def _cosine_rounding(ball: Ball) -> Ball:
    r = _exact(ball)
    z = _times(r, r)
    return _plus(_times(z, _horner(COSINE, z)), _exact(1.0))[1]


def main() -> int:
    """Prove it all and say so."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--balls", type=int, default=BALLS)
    found = prove(parser.parse_args().balls)
    sys.stdout.write(
        f"sine within {found.sine:.4g}, cosine within {found.cosine:.4g},"
        f" stated 2^-49 = {STATED:.4g}: {'proved' if found.holds else 'NOT proved'}"
        f" on {found.balls} balls\n"
    )
    return 0 if found.holds else 1


if __name__ == "__main__":
    sys.exit(ended(main))
