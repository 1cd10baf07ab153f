"""Exact elimination against eigenvalues and against products that must be definite."""

from __future__ import annotations

import numpy as np
import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.check.arithmetic.definite import positive


def exact(rows):
    return [[fmpq(int(x)) for x in row] for row in rows]


@pytest.mark.parametrize(
    ("rows", "semidefinite", "definite"),
    [
        ([[1, 0], [0, 1]], True, True),
        ([[1, 1], [1, 1]], True, False),
        ([[0, 0], [0, 0]], True, False),
        ([[0, 1], [1, 0]], False, False),
        ([[0, 0], [0, 1]], True, False),
        ([[1, 2], [2, 1]], False, False),
        ([[1, 2], [0, 5]], False, False),  # not symmetric
        ([[1, 2, 3]], False, False),  # not square
        ([[2, -1, 0], [-1, 2, -1], [0, -1, 2]], True, True),
        ([[-1]], False, False),
    ],
)
def test_small_matrices(rows, semidefinite, definite):
    assert positive(exact(rows)) is semidefinite
    assert positive(exact(rows), definite=True) is definite


square = st.integers(1, 6).flatmap(
    lambda n: st.lists(
        st.lists(st.integers(-4, 4), min_size=n, max_size=n), min_size=n, max_size=n
    )
)


@settings(max_examples=100)
@given(square)
def test_against_eigenvalues(rows):
    a = np.array(rows)
    assert positive(exact(a @ a.T))
    symmetric = a + a.T
    least = np.linalg.eigvalsh(symmetric)[0]
    if abs(least) > 1e-9:
        assert positive(exact(symmetric)) is bool(least > 0)
        assert positive(exact(symmetric), definite=True) is bool(least > 0)
