import casadi as ca
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.symbolic import Tape
from rrnn_opt.symbolic.linear import (
    backward_solve,
    cholesky,
    cholesky_solve,
    forward_solve,
)


def evaluate(rule, *arrays):
    symbols = [ca.SX.sym(f"a{k}", *np.shape(a)) for k, a in enumerate(arrays)]
    return np.asarray(ca.Function("f", symbols, [rule(*symbols)])(*arrays))


def definite(seed, m):
    a = np.random.default_rng(seed).normal(size=(m, m))
    return a @ a.T + 0.1 * np.eye(m)


@given(seed=st.integers(0, 10_000), m=st.integers(1, 6), k=st.integers(1, 3))
@settings(max_examples=30)
def test_against_numpy(seed, m, k):
    matrix = definite(seed, m)
    right = np.random.default_rng(seed + 1).normal(size=(m, k))
    factor = evaluate(cholesky, matrix)
    np.testing.assert_allclose(factor, np.linalg.cholesky(matrix), atol=1e-12)
    ahead = evaluate(forward_solve, factor, right)
    np.testing.assert_allclose(factor @ ahead, right, atol=1e-10)
    behind = evaluate(backward_solve, factor, right)
    np.testing.assert_allclose(factor.T @ behind, right, atol=1e-10)
    x = evaluate(cholesky_solve, matrix, right[:, :1])
    np.testing.assert_allclose(matrix @ x, right[:, :1], atol=1e-9)


@pytest.mark.parametrize("m", [1, 3, 6])
def test_only_half_of_the_matrix_is_read(m):
    matrix = definite(3, m)
    spoiled = matrix + np.triu(np.full((m, m), np.nan), 1)
    got = evaluate(cholesky, spoiled)
    np.testing.assert_array_equal(got, evaluate(cholesky, matrix))
    assert np.isfinite(got).all()


def test_the_operations_of_a_factorisation():
    a, b = ca.SX.sym("a", 3, 3), ca.SX.sym("b", 3)
    tape = Tape.of(ca.Function("f", [a, b], [cholesky_solve(a, b)]))
    assert tape.operations - {"input", "output"} == {
        "add",
        "sub",
        "mul",
        "div",
        "sq",
        "sqrt",
    }
