"""Signs of a polynomial that its terms show one by one.

A sum of terms none of which is ever negative is not negative.  A term is a
coefficient times powers of generators; even powers are squares, and an element
of a variable has the sign that its domain gives it.
"""

from __future__ import annotations

from collections.abc import Mapping

from rrnn_opt.check.claims.document import Bound, Element
from rrnn_opt.check.claims.graph.expansion import Polynomial
from rrnn_opt.check.claims.graph.polynomial import NormalForms

Domain = Mapping[Element, tuple[Bound, Bound]]


def never_negative(
    polynomial: Polynomial, forms: NormalForms, domain: Domain, *, strict: bool
) -> bool:
    """Whether every term is >= 0 on the domain (strict: and the sum > 0).

    Args:
        polynomial: a normal form of ``forms``.
        forms: tells which generators are elements of variables.
        domain: (lower, upper) by element.
        strict: a positive constant term is asked for as well.
    """
    positive = False
    for exponents, coefficient in () if polynomial == 0 else polynomial.terms():
        sign = 1 if coefficient > 0 else -1
        for generator, exponent in enumerate(exponents):
            if exponent % 2:
                sign *= _sign(forms.variables.get(generator), domain)
        if sign != 1:
            return False
        positive = positive or not any(exponents)
    return positive or not strict


def _sign(slot: Element | None, domain: Domain) -> int:
    """1: never negative on the domain; -1: never positive; 0: not known."""
    low, high = domain.get(slot, (None, None)) if slot else (None, None)
    if low is not None and low >= 0:
        return 1
    return -1 if high is not None and high <= 0 else 0
