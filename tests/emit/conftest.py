"""An empty cache for the tests of this room, and seeded random graphs."""

import casadi as ca
import numpy as np
import pytest


@pytest.fixture
def cold_cache(tmp_path, monkeypatch):
    """An empty cache of the test's own."""
    folder = tmp_path / "cache"
    monkeypatch.setenv("RRNN_CACHE_DIR", str(folder))
    return folder


EXACT = [
    lambda a, b: a + b,
    lambda a, b: a - b,
    lambda a, b: a * b,
    lambda a, b: a / b,
    lambda a, b: -a,
    lambda a, b: 1 / a,
    lambda a, b: a**2,
    lambda a, b: 2 * a,
    lambda a, b: ca.sqrt(a),
    lambda a, b: ca.sin(a),
    lambda a, b: ca.cos(a),
    lambda a, b: ca.fabs(a),
    lambda a, b: ca.sign(a),
    lambda a, b: ca.floor(a),
    lambda a, b: ca.ceil(a),
    ca.copysign,
    ca.fmin,
    ca.fmax,
    lambda a, b: a < b,
    lambda a, b: a <= b,
    lambda a, b: a == b,
    lambda a, b: a != b,
    lambda a, b: ca.logic_not(a),
    ca.logic_and,
    ca.logic_or,
    lambda a, b: ca.if_else(a, b, 0),
]
"""Operations that IEEE 754 or our own algorithm fixes to the bit."""

TAME = [
    lambda a, b: (a + b) / 2,
    lambda a, b: (a - b) / 2,
    lambda a, b: a * b / 4,
    lambda a, b: a / (3 + ca.sin(b)),
    lambda a, b: ca.sqrt(1 + a**2) / 2,
    lambda a, b: ca.sin(a),
    lambda a, b: ca.cos(a + b),
    lambda a, b: ca.fabs(a),
    ca.fmin,
    ca.fmax,
    lambda a, b: ca.tan(a / 4),
    lambda a, b: ca.atan2(a, 3 + b),
    lambda a, b: ca.exp(a / 4) / 2,
]
"""Operations that stay within [-4, 4] and magnify errors little."""


def random_function(name, seed, operations, steps):
    """A function of a vector and a sparse matrix with dense and sparse results."""
    rng = np.random.default_rng(seed)
    x = ca.SX.sym("x", 4)
    a = ca.SX.sym("a", ca.Sparsity.lower(2))
    pool = [*(x[k] for k in range(4)), *a.nonzeros(), ca.SX(0.3), ca.SX(-1.75)]
    for _ in range(steps):
        left, right = (
            pool[rng.integers(max(0, len(pool) - 15), len(pool))] for _ in "ab"
        )
        pool.append(operations[rng.integers(len(operations))](left, right))
    matrix = ca.SX(2, 3)
    matrix[0, 1], matrix[1, 2] = pool[-1], pool[-3]
    return ca.Function(
        name, [x, a], [ca.vertcat(*pool[-8:]), matrix], ["x", "a"], ["v", "m"]
    )


@pytest.fixture(scope="session")
def wild_functions():
    """Graphs of exact operations; infinities and NaN are welcome."""
    return [random_function(f"wild{k}", k, EXACT, 40) for k in range(24)]


@pytest.fixture(scope="session")
def tame_functions():
    """Well-conditioned graphs, library functions among their operations."""
    return [random_function(f"tame{k}", 100 + k, TAME, 25) for k in range(10)]
