"""Claims about linear systems: reading them, and methods "lmi" and "spectrum".

The claim: every solution of x' = A(t) x, with A(t) anywhere in the convex hull of
the vertices A_i at every time, decays as exp(-rate t); or, discrete, of
x_{k+1} = A_k x_k as rate^k.  It is written down as::

    {"form": "decay", "id", "source", "statement", "fingerprint", "order",
     "jacobian", "vertices": [[["p/q", ..], ..], ..], "rate": "p/q",
     "discrete": false, "hypotheses": [[id, statement, not in the source], ..]}

lmi: one rational Q > 0 with -(A_i'Q + Q A_i) - 2 rate Q >= 0 at every vertex
(discrete: rate^2 Q - A_i'Q A_i >= 0); both are affine (discrete: convex) in A, so
they hold in the hull, and V = x'Qx decays.  Payload: ``{"Q": [["p/q", ..], ..]}``.
spectrum: a vertex with an eigenvalue that decays more slowly, in balls of Arb; that
refutes.  Payload: null; witness: ``{"vertex": ["number"]}``.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from flint import fmpq, fmpq_mat

from rrnn_opt.check.arithmetic.definite import positive
from rrnn_opt.check.claims.answer import Answer
from rrnn_opt.check.claims.document import WHERE, read_rational
from rrnn_opt.errors import DocumentError, UndecidedError

MAX_SIZE = 200
Matrix = Any  # flint.fmpq_mat: python-flint has no usable stubs


@dataclass(frozen=True)
class DecayGraph:
    """A claim of decay as read.

    Attributes:
        vertices: square matrices of one size.
        rate: decay rate, or contraction factor when discrete.
        discrete: whether time is discrete.
        added: hypotheses that the source does not state, "id: statement".
        worded: ids of all hypotheses; they are in words only.
        fingerprint: computed from all of this.
    """

    vertices: tuple[Matrix, ...]
    rate: fmpq
    discrete: bool
    added: tuple[str, ...]
    worded: tuple[str, ...]
    fingerprint: str


def read_decay(data: Mapping[str, Any]) -> DecayGraph:
    """Read the "claim" block of a certificate.

    Raises:
        DocumentError: something is missing or of a wrong kind.
    """
    try:
        vertices = [
            [[str(x) for x in row] for row in rows] for rows in data["vertices"]
        ]
        rate, discrete = data["rate"], data["discrete"]
        assumed = [(str(a), str(b), bool(c)) for a, b, c in data["hypotheses"]]
        matrices = tuple(_matrix(rows) for rows in vertices)
        sizes = {m.nrows() for m in matrices} | {m.ncols() for m in matrices}
        if len(sizes) != 1 or not 0 < max(sizes) <= MAX_SIZE:
            raise ValueError("vertices are square matrices of one size")
        speed = _rational(rate)
        if not isinstance(discrete, bool) or speed < 0 or (discrete and speed > 1):
            raise ValueError("a rate is >= 0, a contraction factor in [0, 1]")
        order, jacobian = data["order"], data["jacobian"]
    except (KeyError, TypeError, ValueError, ZeroDivisionError) as error:
        raise DocumentError(WHERE, f"not readable ({error!r})") from error
    hypotheses = [[text, added] for _, text, added in assumed]
    content = ["decay", vertices, rate, discrete, order, jacobian, hypotheses]
    fingerprint = hashlib.sha256(json.dumps(content).encode()).hexdigest()
    extra = tuple(f"{name}: {text}" for name, text, added in assumed if added)
    words = tuple(name for name, _, _ in assumed)
    return DecayGraph(matrices, speed, discrete, extra, words, fingerprint)


def judge(graph: DecayGraph, payload: Any, document: Any) -> Answer:
    """Eliminate in Q and in the inequality of every vertex.

    Raises:
        UndecidedError: one of them is not definite enough.
        DocumentError: the payload is not readable.
    """
    size = graph.vertices[0].nrows()
    try:
        q = _matrix(payload["Q"])
    except (KeyError, TypeError, ValueError, ZeroDivisionError) as error:
        raise DocumentError(WHERE, f"payload not readable ({error!r})") from error
    if (q.nrows(), q.ncols()) != (size, size):
        raise DocumentError(WHERE, f"payload: Q is {size} x {size}")
    if not positive(q.tolist(), definite=True):
        raise UndecidedError("Q is not symmetric and positive definite")
    for k, vertex in enumerate(graph.vertices):
        if graph.discrete:
            left = q * (graph.rate * graph.rate) - vertex.transpose() * q * vertex
        else:
            product = q * vertex
            left = -(product + product.transpose()) - q * (2 * graph.rate)
        if not positive(left.tolist()):
            raise UndecidedError(f"the inequality fails at vertex {k}")
    number = len(graph.vertices)
    reason = f"one quadratic function decays at the claimed rate at {number} vertices"
    return Answer("PROVED", reason, "exact")


def judge_spectrum(graph: DecayGraph, payload: Any, document: Any) -> Answer:
    """An eigenvalue of the named vertex decays too slowly, for certain.

    Raises:
        UndecidedError: none does, or the claim has hypotheses, which in words
            nobody can hold against the vertex.
        DocumentError: the witness is not readable.
    """
    if graph.worded:
        named = ", ".join(graph.worded)
        raise UndecidedError(f"hypotheses in words only ({named}) cannot be replayed")
    try:
        (number,) = document["witness"]["vertex"]
        index = int(read_rational(number))
        if not 0 <= index < len(graph.vertices):
            raise ValueError(f"there is no vertex {index}")
    except (KeyError, TypeError, ValueError, ZeroDivisionError) as error:
        raise DocumentError(WHERE, f"witness not readable ({error!r})") from error
    for root, _ in graph.vertices[index].charpoly().complex_roots():
        slow = abs(root) > graph.rate if graph.discrete else root.real > -graph.rate
        if slow:
            text = root.str(6, radius=False)
            reason = f"vertex {index} has the eigenvalue {text}"
            return Answer("REFUTED", reason, "arb")
    raise UndecidedError(f"no eigenvalue of vertex {index} is certain to be too slow")


def _matrix(rows: Any) -> Matrix:
    return fmpq_mat([[_rational(x) for x in row] for row in rows])


def _rational(text: object) -> fmpq:
    return fmpq(*read_rational(text).as_integer_ratio())
