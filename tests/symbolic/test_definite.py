from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.symbolic.definite import negative_direction

LAWS = settings(max_examples=80)
integers = st.integers(-3, 3)
squares = st.integers(1, 5).flatmap(
    lambda n: st.lists(
        st.lists(integers, min_size=n, max_size=n), min_size=n, max_size=n
    )
)


def _form(P, v):
    return sum(
        v[i] * Fraction(float(P[i][j])) * v[j]
        for i in range(len(v))
        for j in range(len(v))
    )


@LAWS
@given(A=squares)
def test_gram_matrices_are_semidefinite_even_when_singular(A):
    A = np.array(A, dtype=float)
    assert negative_direction(A @ A.T) is None


@LAWS
@given(A=squares)
def test_the_direction_is_a_proof(A):
    P = np.array(A, dtype=float)
    P = P + P.T
    v = negative_direction(P)
    if v is None:
        assert np.linalg.eigvalsh(P)[0] > -1e-9
    else:
        assert _form(P, v) < 0


def test_one_unit_in_the_last_place_decides():
    below = np.nextafter(1.0, 0.0)
    assert negative_direction([[1.0, 1.0], [1.0, 1.0]]) is None
    v = negative_direction([[1.0, 1.0], [1.0, below]])
    assert v is not None
    assert _form([[1.0, 1.0], [1.0, below]], v) == Fraction(below) - 1


@pytest.mark.parametrize(
    "P", [[[0.0, 1.0], [1.0, 0.0]], [[0.0, 1.0], [1.0, 5.0]], [[-1.0]]]
)
def test_zero_pivots_do_not_hide_negative_curvature(P):
    v = negative_direction(P)
    assert v is not None
    assert _form(P, v) < 0


def test_only_symmetric_matrices():
    with pytest.raises(ValueError, match="symmetric"):
        negative_direction([[1.0, 0.0], [1e-300, 1.0]])
