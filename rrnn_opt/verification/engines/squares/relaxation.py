"""What an identity of squares and products can be made of, up to a degree.

The parts are those of :mod:`rrnn_opt.check.claims.methods.sos`; the finders
:mod:`products` (linear programme) and :mod:`sos` (semidefinite programme) look
for their coefficients.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from rrnn_opt.check.claims.graph.expansion import Polynomial, remainder
from rrnn_opt.check.claims.graph.semialgebraic import Semialgebraic
from rrnn_opt.errors import UndecidedError

Monomial = tuple[tuple[int, int], ...]
Sparse = dict[Monomial, Any]

MOST_FACTORS = 200
"""Of more inequalities that belong together, no products are made."""
MAX_PARTS = 4000
"""Products and multipliers of one relaxation."""


@dataclass(frozen=True)
class Relaxation:
    """The parts at hand for one element of a goal.

    Attributes:
        setting: the claim as polynomials.
        target: the polynomial that is to be shown non-negative.
        strict: whether positive is claimed.
        generators: numbers of the generators that matter.
        products: inequalities multiplied, with the numbers of the factors; the
            first is 1.
        multipliers: (number of an equation, monomial).
        degree: no part exceeds it.
    """

    setting: Semialgebraic
    target: Polynomial
    strict: bool
    generators: tuple[int, ...]
    products: tuple[tuple[tuple[int, ...], Polynomial], ...]
    multipliers: tuple[tuple[int, Polynomial], ...]
    degree: int

    def reduced(self, p: Polynomial) -> Polynomial:
        """A polynomial without squares of cosines."""
        return remainder(p, self.setting.forms.circles)

    def monomials(self, degree: int) -> list[Polynomial]:
        """All monomials of the generators up to a degree, 1 first.

        Raises:
            UndecidedError: there are too many.
        """
        return list(_monomials(self.setting, self.generators, degree))


def relaxation(
    setting: Semialgebraic, target: Polynomial, degree: int, *, strict: bool
) -> Relaxation:
    """All parts up to a degree.

    Raises:
        UndecidedError: there are too many.
    """
    generators = relevant(setting, target)
    inside = [
        (k, g)
        for k, g in enumerate(setting.inequalities)
        if g != 0 and generators_of(g) <= set(generators)
    ]
    products = list(_products(setting, target, inside, degree))
    multipliers = [
        (k, monomial)
        for k, h in enumerate(setting.equalities)
        if h != 0 and generators_of(h) <= set(generators)
        for monomial in _monomials(setting, generators, degree - h.total_degree())
    ]
    if len(products) + len(multipliers) > MAX_PARTS:
        raise UndecidedError(
            f"{len(products) + len(multipliers)} parts of degree {degree} are too many"
        )
    return Relaxation(
        setting,
        target,
        strict,
        generators,
        tuple(products),
        tuple(multipliers),
        degree,
    )


def sparse(p: Polynomial) -> Sparse:
    """Coefficients by monomial."""
    if p == 0:
        return {}
    return {
        tuple((g, int(e)) for g, e in enumerate(exponents) if e): coefficient
        for exponents, coefficient in p.terms()
    }


def written(p: Polynomial) -> list[Any]:
    """A polynomial as the payload writes it."""
    return [[str(c), [list(power) for power in m]] for m, c in sparse(p).items()]


def generators_of(p: Polynomial) -> set[int]:
    """Numbers of the generators that occur in a polynomial."""
    return {g for g, degree in enumerate(p.degrees()) if degree > 0}


def relevant(setting: Semialgebraic, target: Polynomial) -> tuple[int, ...]:
    """Generators of the target, and of all that is said of them, repeatedly."""
    known = generators_of(target)
    sets = [generators_of(p) for p in (*setting.inequalities, *setting.equalities)]
    sets += [generators_of(circle) for _, circle in setting.forms.circles]
    size = -1
    while size != len(known):
        size = len(known)
        for generators in sets:
            if generators & known:
                known |= generators
    return tuple(sorted(known))


def _components(setting: Semialgebraic, target: Polynomial) -> dict[int, int]:
    """A number for every set of generators that laws or terms tie together."""
    component: dict[int, int] = {}
    laws = [generators_of(p) for p in (*setting.inequalities, *setting.equalities)]
    for tied in laws + [{g for g, _ in monomial} for monomial in sparse(target)]:
        old = {component[g] for g in tied if g in component}
        new = min(old | tied, default=0)
        component.update({g: new for g, c in component.items() if c in old})
        component.update(dict.fromkeys(tied, new))
    return component


def _products(
    setting: Semialgebraic,
    target: Polynomial,
    inside: Sequence[tuple[int, Polynomial]],
    degree: int,
) -> Iterator[tuple[tuple[int, ...], Polynomial]]:
    """1, the inequalities, and products of two or three that belong together."""
    yield (), setting.forms.ring.constant(1)
    for k, g in inside:
        if g.total_degree() <= degree:
            yield (k,), g
    component = _components(setting, target)
    groups: dict[int, list[tuple[int, Polynomial]]] = {}
    for k, g in inside:
        tied = generators_of(g)
        if tied:
            groups.setdefault(component[min(tied)], []).append((k, g))
    for group in groups.values():
        yield from _tuples(setting, group, degree)


def _tuples(
    setting: Semialgebraic, group: Sequence[tuple[int, Polynomial]], degree: int
) -> Iterator[tuple[tuple[int, ...], Polynomial]]:
    if len(group) > MOST_FACTORS:
        return
    crowded = len(group) > _FEW[2]
    for count in (n for n in _FEW if n == 2 or len(group) <= _FEW[n]):
        for chosen in itertools.combinations_with_replacement(group, count):
            factors = [g for _, g in chosen]
            if sum(g.total_degree() for g in factors) > degree:
                continue
            near = not crowded or generators_of(factors[0]) & generators_of(factors[1])
            if near:
                product = factors[0]
                for g in factors[1:]:
                    product = remainder(product * g, setting.forms.circles)
                yield tuple(k for k, _ in chosen), product


_FEW = {2: 40, 3: 20, 4: 10}
"""Of more inequalities, fewer products of so many factors are made."""


def _monomials(
    setting: Semialgebraic, generators: Sequence[int], degree: int
) -> Iterator[Polynomial]:
    count = math.comb(len(generators) + degree, degree) if degree >= 0 else 0
    if count > MAX_PARTS:
        raise UndecidedError(f"{count} monomials of degree {degree} are too many")
    ring = setting.forms.ring
    cosines = {cosine for cosine, _ in setting.forms.circles}
    for d in range(degree + 1):
        for chosen in itertools.combinations_with_replacement(generators, d):
            if all(chosen.count(c) < 2 for c in cosines.intersection(chosen)):
                monomial = ring.constant(1)
                for g in chosen:
                    monomial *= ring.gen(g)
                yield monomial
