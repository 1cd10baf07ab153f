"""Engine "lmi": a quadratic Lyapunov function for the vertices of a linear system.

Q > 0 with ``A_i'Q + Q A_i + 2 rate Q <= 0`` at every vertex (discrete:
``A_i'Q A_i <= rate^2 Q``) is found by Clarabel and rounded (Boyd, El Ghaoui, Feron,
Balakrishnan, "Linear Matrix Inequalities in System and Control Theory", SIAM 1994,
section 5.1).  A vertex with an eigenvalue that is too slow refutes the claim.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.decay import DecayClaim
from rrnn_opt.errors import UndecidedError
from rrnn_opt.verification.document import document_of, heading
from rrnn_opt.verification.engines.conic import ConicProgram, require_clarabel, solve

Array = NDArray[np.float64]
_BITS = (12, 24, 48)
_NEAR = 1e-9  # how much too slow an eigenvalue must look in floating point


def propose(
    claim: DecayClaim, *, budget_s: float, seed: int
) -> Iterator[dict[str, Any]]:
    """A vertex that refutes, or rational matrices Q.

    Raises:
        UndecidedError: neither was found, or Clarabel is not installed.
    """
    vertices = np.array([[[float(x) for x in r] for r in v] for v in claim.vertices])
    excess = _slowest(vertices, claim)
    worst = int(np.argmax(excess))
    if excess[worst] > _NEAR:
        yield decay_document(claim, "spectrum", witness={"vertex": [str(worst)]})
    require_clarabel()
    found = solve(_program(vertices, float(claim.rate), claim.discrete), budget_s)
    if found is None:
        raise UndecidedError("Clarabel found no quadratic function")
    least, values = found
    if least <= 0:
        raise UndecidedError(
            f"no quadratic function decays at every vertex (margin {least:.1e})"
        )
    size = vertices.shape[1]
    for bits in _BITS:
        rounded = [Fraction(round(x * 2**bits), 2**bits) for x in values.tolist()]
        text = [str(x) for x in rounded[: size * (size + 1) // 2]]
        full = [[text[_place(i, j)] for j in range(size)] for i in range(size)]
        yield decay_document(claim, "lmi", payload={"Q": full})


def decay_document(
    claim: DecayClaim, method: str, *, payload: Any = None, witness: Any = None
) -> dict[str, Any]:
    """The document that asks the checker to settle a claim of decay."""
    block = {
        "form": "decay",
        **heading(claim),
        "vertices": [[[str(x) for x in row] for row in v] for v in claim.vertices],
        "rate": str(claim.rate),
        "discrete": claim.discrete,
        "hypotheses": [[h.id, h.statement, h.added] for h in claim.hypotheses],
    }
    return document_of(block, method, payload, witness)


def _slowest(vertices: Array, claim: DecayClaim) -> Array:
    """By how much the slowest eigenvalue of each vertex misses the rate."""
    roots = np.linalg.eigvals(vertices)
    rate = float(claim.rate)
    if claim.discrete:
        return np.asarray(np.max(np.abs(roots), axis=1) - rate)
    return np.asarray(np.max(roots.real, axis=1) + rate)


def _place(i: int, j: int) -> int:
    """Where entry (i, j) stands among the upper triangle's, column by column."""
    low, high = min(i, j), max(i, j)
    return high * (high + 1) // 2 + low


def _program(vertices: Array, rate: float, discrete: bool) -> ConicProgram:
    """Q - t I >= 0, I - Q - t I >= 0 and the inequality at every vertex, - t I."""
    size = vertices.shape[1]
    entries = size * (size + 1) // 2
    maps = [_map(a, rate, discrete) for a in vertices]
    table = np.vstack([*maps, np.eye(entries)])
    matrix = np.hstack([table, np.eye(len(table))])
    right = np.zeros(len(table))
    right[-entries:] = [float(i == j) for j in range(size) for i in range(j + 1)]
    return ConicProgram(matrix, right, (size,) * (len(vertices) + 2))


def _map(a: Array, rate: float, discrete: bool) -> Array:
    """What a vertex makes of Q's entries: A'Q + QA + 2 rate Q, as columns."""
    size = len(a)
    columns = []
    for j in range(size):
        for i in range(j + 1):
            q = np.zeros((size, size))
            q[i, j] = q[j, i] = 1.0
            image = a.T @ q @ a - rate**2 * q if discrete else a.T @ q + q @ a
            image = image if discrete else image + 2 * rate * q
            columns.append([image[k, m] for m in range(size) for k in range(m + 1)])
    return np.array(columns).T
