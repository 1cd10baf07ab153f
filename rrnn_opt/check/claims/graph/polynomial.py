"""Exact normal forms: an expression graph as polynomials over the rationals.

Every value of a graph becomes a polynomial with rational coefficients in

* the elements of its variables,
* one pair (sin a, cos a) for every different argument a, with
  (cos a)^2 replaced by 1 - (sin a)^2, and
* one atom for every other operation, e.g. fmin(p, q), known by the operation
  and the normal forms of its operands: equal operands give the same atom.

Doubles are exact rational numbers here, so nothing is rounded.  Only true
equations are used, hence a result whose normal form is 0 is zero wherever the
graph is defined.  The converse does not hold: a normal form other than 0
settles nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from rrnn_opt.check.claims.document import ClaimGraph
from rrnn_opt.check.claims.graph.expansion import PARTIAL, Expansion, Polynomial

WORK = 100_000_000
"""Default budget: products of two terms (a few seconds at most)."""


@dataclass(frozen=True)
class NormalForms:
    """What the expansion of a graph gave.

    Attributes:
        results: polynomial by (output, element) of the output that was asked
            for; an element without one is 0.
        variables: (variable, element) by generator number, for the generators
            that are elements of variables.
        partial: operations met that are not defined everywhere, sorted.
        work: products of terms that were spent.
        ring: the polynomial ring.
        atoms: operation, operands and generator of every atom.
        angles: angle, sine and cosine of every pair.
        circles: number of the cosine and c^2 + s^2 - 1 of every pair.
    """

    results: dict[tuple[int, int], Polynomial]
    variables: dict[int, tuple[int, int]]
    partial: tuple[str, ...]
    work: int
    ring: Any
    atoms: tuple[tuple[str, tuple[Polynomial, ...], Polynomial], ...]
    angles: tuple[tuple[Polynomial, Polynomial, Polynomial], ...]
    circles: tuple[tuple[int, Polynomial], ...]

    @property
    def partial_atoms(self) -> int:
        """Number of different atoms that are not defined everywhere."""
        return sum(op in PARTIAL for op, _, _ in self.atoms)


def normal_forms(
    graph: ClaimGraph, *, outputs: Sequence[int] = (0,), work: int = WORK
) -> NormalForms:
    """Expand some outputs of a graph; what they do not need is not looked at.

    Args:
        graph: claim as read.
        outputs: their numbers; 0 is the goal.
        work: budget, products of two terms.

    Raises:
        UndecidedError: an operation that is not known here, a constant that is
            not finite, a division by zero, or the budget is spent.
    """
    expansion = Expansion(graph, work)
    needed = _needed(graph, outputs)
    for step in graph.steps:
        if step.op == "output":
            if step.slot is not None and step.slot[0] in outputs:
                expansion.results[step.slot] = expansion.values[step.args[0]]
        elif step.out in needed:
            expansion.values[step.out] = expansion.value(step)
    return NormalForms(
        expansion.results,
        expansion.variables,
        tuple(sorted(expansion.partial)),
        work - expansion.budget,
        expansion.ring,
        tuple(expansion.atoms),
        tuple(expansion.angles),
        tuple(expansion.circles),
    )


def _needed(graph: ClaimGraph, outputs: Sequence[int]) -> set[int]:
    needed: set[int] = set()
    for step in reversed(graph.steps):
        if step.op == "output":
            wanted = step.slot is not None and step.slot[0] in outputs
        else:
            wanted = step.out in needed
        needed.update(step.args if wanted else ())
    return needed
