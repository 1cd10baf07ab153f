"""Engine "sos": an identity of squares, found by a semidefinite programme.

The Gram matrices of :mod:`rrnn_opt.check.claims.methods.sos` are sought with their
least eigenvalue as large as possible (Clarabel, in a process of its own), rounded to
dyadic numbers and moved back onto the identity in rational arithmetic (Peyrl and
Parrilo, Theor. Comput. Sci. 409 (2008) 269-281).  Where the least eigenvalue is
0, the kernel that is seen in floating point is written in small rationals and
split off, and the search starts again on what is left.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.check.claims.graph.expansion import Polynomial
from rrnn_opt.check.claims.graph.semialgebraic import Semialgebraic
from rrnn_opt.claim import Claim
from rrnn_opt.errors import UndecidedError
from rrnn_opt.verification.engines.conic import require_clarabel, solve
from rrnn_opt.verification.engines.squares.kernel import complement
from rrnn_opt.verification.engines.squares.proposal import element_by_element
from rrnn_opt.verification.engines.squares.relaxation import Relaxation, relaxation
from rrnn_opt.verification.engines.squares.system import Block, System

Array = NDArray[np.float64]
MAX_DEGREE = 8
MAX_ENTRIES = 4000
"""Entries of all Gram matrices together."""
_BITS = (20, 30, 45)
_FLAT = 1e-6  # a least eigenvalue that may be 0
_ROUNDS = 4


def propose(claim: Claim, *, budget_s: float, seed: int) -> Iterator[dict[str, Any]]:
    """One certificate of all elements, or the reason why there is none.

    Raises:
        UndecidedError: no identity of this form was found, or Clarabel is not
            installed.
    """
    if claim.goal.sense == "==0":
        raise UndecidedError("an equation has no sum of squares here")
    require_clarabel()
    yield from element_by_element(claim, _proof, what="squares", budget_s=budget_s)


def _proof(
    setting: Semialgebraic, goal: Polynomial, end: float
) -> dict[str, Any] | None:
    target = goal if setting.sense[0] == ">" else -goal
    strict = "=" not in setting.sense
    even = max(2, 2 * ((target.total_degree() + 1) // 2))
    if even > MAX_DEGREE:
        raise UndecidedError(f"degree {even} of the goal is too high")
    for degree in range(even, min(even + 2, MAX_DEGREE) + 1, 2):
        parts = relaxation(setting, target, degree, strict=strict)
        proof = _search(parts, end)
        if proof is not None:
            return proof
    return None


def _blocks(parts: Relaxation) -> list[Block]:
    blocks = []
    for factors, product in parts.products:
        room = (parts.degree - max(0, product.total_degree())) // 2
        blocks.append(Block(factors, product, tuple(parts.monomials(room))))
    entries = sum(len(b.basis) * (len(b.basis) + 1) // 2 for b in blocks)
    if entries > MAX_ENTRIES:
        raise UndecidedError(f"Gram matrices of {entries} entries are too large")
    return blocks


def _search(parts: Relaxation, end: float) -> dict[str, Any] | None:
    blocks = _blocks(parts)
    for _ in range(_ROUNDS):
        left = end - time.monotonic()
        if left <= 0:
            return None
        system = System(parts, blocks)
        found = solve(system.program(), left)
        if found is None:
            return None
        least, values = found
        if least < -_FLAT:
            return None
        for bits in _BITS if least > 0 else ():
            exact = system.rounded(values, bits)
            if exact is not None:
                return system.written(exact)
        pairs = zip(blocks, system.grams(values), strict=True)
        blocks = [b for b in (_faced(*pair) for pair in pairs) if b.basis]
        if sum(len(b.basis) for b in blocks) == system.width:
            return None
    return None


def _faced(block: Block, gram: Array) -> Block:
    """The block on the complement of its matrix's kernel."""
    rows = complement(gram)
    if rows is None:
        return block
    zero = block.product * 0
    basis = [
        sum((b * x for b, x in zip(block.basis, row, strict=True) if x != 0), zero)
        for row in rows
    ]
    return replace(block, basis=tuple(basis))
