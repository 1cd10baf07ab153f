"""Oracle: ball arithmetic, on a fine grid and at the edges of the reduction."""

import itertools
import math

import flint
import numpy as np
import pytest

from rrnn_opt.check.arithmetic import sincos

U = 2.0**-53


def ball(x):
    return flint.arb(float(x))


def worst_error(x):
    """Largest |computed - true| over all arguments, in u."""
    s, c = sincos.sincos(x)
    with flint.ctx.workprec(160):
        errors = [
            max(
                float(abs(ball(a).sin() - ball(b))), float(abs(ball(a).cos() - ball(d)))
            )
            for a, b, d in zip(x, s, c, strict=True)
        ]
    return max(errors) / U


def test_the_reduced_range_on_a_grid():
    assert worst_error(np.linspace(-0.7855, 0.7855, 6001)) < 4.0


def test_arguments_up_to_the_limit():
    rng = np.random.default_rng(0)
    turns = np.rint(rng.uniform(-6e5, 6e5, 1500))
    for x in (
        rng.uniform(-10, 10, 3000),
        rng.uniform(-sincos.LARGEST, sincos.LARGEST, 1500),
        turns * (np.pi / 2),  # nearest doubles: sine or cosine almost vanish
        (turns + 0.5) * (np.pi / 2),  # where the quarter changes
        np.array([0.0, 5e-324, -1e-300, sincos.LARGEST, -sincos.LARGEST]),
    ):
        assert worst_error(x) * U < sincos.ERROR


def test_the_facts_that_the_proof_rests_on():
    """Bits of the parts, their rest, and Taylor's remainders, in balls."""
    parts = [sincos._P1, sincos._P2, sincos._P3]
    bits = [p.as_integer_ratio()[0].bit_length() for p in parts]
    assert max(bits[:2]) + 20 <= 53  # so k times a part is exact
    with flint.ctx.workprec(300):
        rest = flint.arb.pi() / 2 - sum(map(ball, parts), flint.arb(0))
        assert abs(rest) < ball(2.0**-120)
        quarter = flint.arb.pi() / 4 + ball(2.0**20) * ball(1e-15)
        assert quarter < ball(0.7855)
        r = ball(0.7855)
        assert r**19 / math.factorial(19) < ball(0.03 * U)
        assert r**18 / math.factorial(18) < ball(0.03 * U)
        # Horner's rule: each step's value is at most half of the next one's
        for row in (sincos._SINE, sincos._COSINE):
            z = r * r
            for high, low in itertools.pairwise(row):
                assert abs(ball(high)) * z * 2 < abs(ball(low))


@pytest.mark.parametrize("x", [np.nan, np.inf, -np.inf, 1.0001e6, -1e300])
def test_beyond_the_limit_nothing_is_said(x):
    s, c = sincos.sincos(np.array([x, 1.0]))
    assert np.isnan(s[0])
    assert np.isnan(c[0])
    assert s[1] == pytest.approx(math.sin(1.0), abs=1e-15)
