"""A claim as polynomials: what is claimed, and what may be assumed.

The generators are those of :mod:`rrnn_opt.check.claims.graph.polynomial`: variables,
pairs (sin a, cos a), and one atom an operation that is no polynomial.  Domain and
hypotheses become inequalities g >= 0 and equations h = 0; so does what is known
of an atom t, whatever its operands are::

    t = fmin(a, b)     a - t >= 0, b - t >= 0, (a - t)(b - t) = 0
    t = fmax(a, b)     t - a >= 0, t - b >= 0, (t - a)(t - b) = 0
    t = fabs(a)        t >= 0, t - a >= 0, t + a >= 0, t^2 - a^2 = 0
    t = sqrt(a)        t >= 0, t^2 - a = 0          t = inv(a)   t a - 1 = 0
    t = (a <= b)       t(1 - t) = 0, t(b - a) >= 0, (1 - t)(a - b) >= 0
    t = (a == b)       t(1 - t) = 0, t(a - b) = 0
    t = not a, a and b, a or b, if_else_zero(a, b), for a, b of 0 or 1:
                       t = 1 - a, a b, a + b - a b, a b

An atom also splits into two cases, at least one of which holds::

    fmin(a, b):  t = a, b - a >= 0    or   t = b, a - b >= 0
    fmax(a, b):  t = a, a - b >= 0    or   t = b, b - a >= 0
    fabs(a):     t = a, a >= 0        or   t = -a, -a >= 0
    a <= b:      t = 1, b - a >= 0    or   t = 0, a - b >= 0

Of angles known as a sum, a = b + c, the addition theorems are equations.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

from flint import fmpq

from rrnn_opt.check.claims.document import Bound, ClaimGraph
from rrnn_opt.check.claims.graph.expansion import Polynomial
from rrnn_opt.check.claims.graph.polynomial import NormalForms, normal_forms

MAX_ANGLES = 12
"""Of more angles than these, no sums are looked for."""


Case = tuple[Polynomial, Polynomial]


@dataclass(frozen=True)
class Semialgebraic:
    """Polynomials of one ring.

    Attributes:
        goals: the elements of the goal.
        sense: of the goal.
        inequalities: each is >= 0 wherever domain and hypotheses are kept.
        equalities: each is 0 there.
        forms: ring, circles and partial operations.
        splits: two cases (equation, inequality) of every atom that has cases.
    """

    goals: tuple[Polynomial, ...]
    sense: str
    inequalities: tuple[Polynomial, ...]
    equalities: tuple[Polynomial, ...]
    forms: NormalForms
    splits: tuple[tuple[Case, Case], ...]

    def assuming(self, split: int, case: int) -> Semialgebraic:
        """The same with one case's equation and inequality appended."""
        equation, inequality = self.splits[split][case]
        return replace(
            self,
            equalities=(*self.equalities, equation),
            inequalities=(*self.inequalities, inequality),
        )


def semialgebraic(graph: ClaimGraph) -> Semialgebraic:
    """Read a claim's goal, domain, hypotheses and atoms as polynomials.

    Raises:
        UndecidedError: the graph cannot be expanded.
    """
    forms = normal_forms(graph, outputs=range(len(graph.outputs)))
    zero = forms.ring.constant(0)
    rows = [
        [forms.results.get((k, e), zero) for e in range(port.size)]
        for k, port in enumerate(graph.outputs)
    ]
    known = list(_domain(graph, forms))
    for sense, row in zip(graph.senses[1:], rows[1:], strict=True):
        known += [(sense[:1].replace(">", "+").replace("<", "-"), p) for p in row]
    known += list(_atoms(forms)) + list(_sums(forms))
    above = [p if sign == "+" else -p for sign, p in known if sign != "="]
    equal = [p for sign, p in known if sign == "="]
    return Semialgebraic(
        tuple(rows[0]),
        graph.senses[0],
        tuple(above),
        tuple(equal),
        forms,
        tuple(_CASES[op](t, *args) for op, args, t in forms.atoms if op in _CASES),
    )


Known = tuple[str, Polynomial]


def _domain(graph: ClaimGraph, forms: NormalForms) -> Iterator[Known]:
    for index, slot in sorted(forms.variables.items(), reverse=True):
        x = forms.ring.gen(index)
        low, high = graph.domain.get(slot, (None, None))
        if low is not None:
            yield "+", x - _rational(low)
        if high is not None:
            yield "-", x - _rational(high)


def _rational(bound: Bound) -> fmpq:
    return fmpq(*bound.as_integer_ratio()) if bound is not None else fmpq(0)


def _atoms(forms: NormalForms) -> Iterator[Known]:
    truths: list[Polynomial] = []
    for op, operands, t in forms.atoms:
        if op in _LAWS:
            yield from _LAWS[op](t, *operands)
        elif op in _LOGIC and all(a in truths for a in operands[: _TRUTHS[op]]):
            yield "=", t - _LOGIC[op](*operands)
        if op in _BOOLEAN:
            truths.append(t)


def _sums(forms: NormalForms) -> Iterator[Known]:
    angles = forms.angles
    if len(angles) > MAX_ANGLES:
        return
    for (a, s1, c1), (b, s2, c2) in itertools.combinations(angles, 2):
        for angle, s, c in angles:
            if angle == a + b:
                yield "=", s - s1 * c2 - c1 * s2
                yield "=", c - c1 * c2 + s1 * s2
            elif angle in (a - b, b - a):
                sign = 1 if angle == a - b else -1
                yield "=", s - sign * (s1 * c2 - c1 * s2)
                yield "=", c - c1 * c2 - s1 * s2


def _fmin(t: Polynomial, a: Polynomial, b: Polynomial) -> tuple[Known, ...]:
    return ("+", a - t), ("+", b - t), ("=", (a - t) * (b - t))


def _fmax(t: Polynomial, a: Polynomial, b: Polynomial) -> tuple[Known, ...]:
    return ("+", t - a), ("+", t - b), ("=", (t - a) * (t - b))


def _fabs(t: Polynomial, a: Polynomial) -> tuple[Known, ...]:
    return ("+", t), ("+", t - a), ("+", t + a), ("=", t * t - a * a)


def _order(t: Polynomial, a: Polynomial, b: Polynomial) -> tuple[Known, ...]:
    return ("=", t * (1 - t)), ("+", t * (b - a)), ("+", (1 - t) * (a - b))


_LAWS: dict[str, Callable[..., tuple[Known, ...]]] = {
    "fmin": _fmin,
    "fmax": _fmax,
    "fabs": _fabs,
    "sqrt": lambda t, a: (("+", t), ("=", t * t - a)),
    "inv": lambda t, a: (("=", t * a - 1),),
    "le": _order,
    "lt": _order,
    "eq": lambda t, a, b: (("=", t * (1 - t)), ("=", t * (a - b))),
    "ne": lambda t, a, b: (("=", t * (1 - t)), ("=", (1 - t) * (a - b))),
}
_LOGIC: dict[str, Callable[..., Polynomial]] = {
    "not": lambda a: 1 - a,
    "and": lambda a, b: a * b,
    "or": lambda a, b: a + b - a * b,
    "if_else_zero": lambda a, b: a * b,
}
_CASES: dict[str, Callable[..., tuple[Case, Case]]] = {
    "fmin": lambda t, a, b: ((t - a, b - a), (t - b, a - b)),
    "fmax": lambda t, a, b: ((t - a, a - b), (t - b, b - a)),
    "fabs": lambda t, a: ((t - a, a), (t + a, -a)),
    "le": lambda t, a, b: ((t - 1, b - a), (t, a - b)),
    "lt": lambda t, a, b: ((t - 1, b - a), (t, a - b)),
}
_TRUTHS = {"not": 1, "and": 2, "or": 2, "if_else_zero": 1}
_BOOLEAN = frozenset({"le", "lt", "eq", "ne", "not", "and", "or"})
