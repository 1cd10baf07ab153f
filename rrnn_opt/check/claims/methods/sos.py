"""Method "sos": an identity that shows the sign of the goal.

For every element p of the goal (its sign turned so that p >= 0 is claimed) the
payload holds the parts of an identity over the rationals::

    p = margin + sum_j  g_j1 .. g_jk  b_j' Q_j b_j  + sum_k  m_k h_k

g and h are the inequalities and equations of
:mod:`rrnn_opt.check.claims.graph.semialgebraic`, b_j columns of polynomials, Q_j
rational matrices without a negative eigenvalue, m_k any polynomials.  The margin is > 0
for a strict goal and >= 0 for ">=0" and "<=0".  For an equation p = 0 it is 0, and
there are no squares, or the identity is that of -p^2.

Instead of an identity there may be ``{"split": s, "cases": [proof, proof]}``: the
two cases of atom s, each with one more equation and inequality at the end of the
lists.

Payload: ``{"elements": [{"margin": "1/2",
"squares": [{"factors": [0, 3], "basis": [P, ..], "gram": [["1/2", ..], ..]}],
"multipliers": [{"equality": 0, "polynomial": P}]}]}`` with polynomials P written
``[["coefficient", [[generator, exponent], ..]], ..]``.
"""

from __future__ import annotations

from typing import Any

from flint import fmpq

from rrnn_opt.check.arithmetic.definite import positive
from rrnn_opt.check.claims.answer import Answer, undefined
from rrnn_opt.check.claims.document import WHERE, ClaimGraph, read_rational
from rrnn_opt.check.claims.graph.expansion import Polynomial, remainder
from rrnn_opt.check.claims.graph.semialgebraic import Semialgebraic, semialgebraic
from rrnn_opt.errors import DocumentError, UndecidedError

MAX_BASIS = 400
MAX_EXPONENT = 64
MAX_DEPTH = 16


def judge(graph: ClaimGraph, payload: Any, document: Any) -> Answer:
    """Expand every identity, and eliminate in every matrix.

    Raises:
        UndecidedError: an identity or a matrix is not what it must be.
        DocumentError: the payload is not readable.
    """
    setting = semialgebraic(graph)
    try:
        elements = list(payload["elements"])
        if len(elements) != len(setting.goals):
            raise ValueError(f"{len(setting.goals)} elements are needed")
        for k, (goal, proof) in enumerate(zip(setting.goals, elements, strict=True)):
            _require(setting, goal, proof, k)
    except (KeyError, TypeError, ValueError, IndexError, ZeroDivisionError) as error:
        raise DocumentError(WHERE, f"payload not readable ({error!r})") from error
    reason = "an identity of squares and products of what is given, over the rationals"
    return Answer("PROVED", reason, "exact", undefined(setting.forms.partial))


def _require(
    setting: Semialgebraic, goal: Polynomial, proof: Any, k: int, depth: int = 0
) -> None:
    if "split" in proof:
        split = _index(proof["split"], len(setting.splits))
        if len(proof["cases"]) != 2 or depth >= MAX_DEPTH:
            raise ValueError("a split has two cases, and there are not too many")
        for case, part in enumerate(proof["cases"]):
            _require(setting.assuming(split, case), goal, part, k, depth + 1)
        return
    target, strict = _target(setting.sense, goal, bool(proof["squares"]))
    margin = _rational(proof["margin"])
    if margin < 0 or (strict and margin == 0) or (setting.sense == "==0" and margin):
        raise UndecidedError(f"element {k}: the margin has the wrong sign")
    rest = target - setting.forms.ring.constant(margin)
    for square in proof["squares"]:
        rest -= _square(setting, square, k)
    for multiplier in proof["multipliers"]:
        index = _index(multiplier["equality"], len(setting.equalities))
        factor = read_polynomial(setting.forms.ring, multiplier["polynomial"])
        rest -= factor * setting.equalities[index]
    if remainder(rest, setting.forms.circles) != 0:
        raise UndecidedError(f"element {k}: the identity does not hold")


def _target(sense: str, goal: Polynomial, squares: bool) -> tuple[Polynomial, bool]:
    """What must not be negative, and whether it must be positive."""
    if sense == "==0":
        return (-goal * goal if squares else goal), False
    return (goal if sense[0] == ">" else -goal), "=" not in sense


def _square(setting: Semialgebraic, square: Any, k: int) -> Polynomial:
    """The polynomial g_1 .. g_n b'Qb, after Q was found without negative pivots."""
    ring = setting.forms.ring
    basis = [read_polynomial(ring, b) for b in square["basis"]]
    gram = [[_rational(x) for x in row] for row in square["gram"]]
    if not 0 < len(basis) == len(gram) <= MAX_BASIS:
        raise ValueError("as many polynomials as rows, and not too many")
    if not positive(gram):
        raise UndecidedError(f"element {k}: a matrix has a negative eigenvalue")
    total = ring.constant(0)
    for i, row in enumerate(gram):
        inner = ring.constant(0)
        for j, x in enumerate(row):
            inner += basis[j] * x
        total += remainder(inner * basis[i], setting.forms.circles)
    for index in square["factors"]:
        total *= setting.inequalities[_index(index, len(setting.inequalities))]
        total = remainder(total, setting.forms.circles)
    return total


def read_polynomial(ring: Any, rows: Any) -> Polynomial:
    """A polynomial written as a list of terms.

    Raises:
        ValueError: it is not one of this ring.
    """
    total = ring.constant(0)
    for coefficient, powers in rows:
        term = ring.constant(_rational(coefficient))
        for generator, exponent in powers:
            if not 0 < exponent <= MAX_EXPONENT:
                raise ValueError(f"exponent {exponent}")
            term *= ring.gen(_index(generator, ring.nvars())) ** exponent
        total += term
    return total


def _rational(text: object) -> fmpq:
    return fmpq(*read_rational(text).as_integer_ratio())


def _index(index: object, count: int) -> int:
    if not (isinstance(index, int) and 0 <= index < count):
        raise ValueError(f"{index!r} is not one of {count}")
    return index
