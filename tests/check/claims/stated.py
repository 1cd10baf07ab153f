"""Small claims and their certificates."""

from __future__ import annotations

from fractions import Fraction

import casadi as ca

from rrnn_opt.check.claims.certificate import (
    check_certificate,
)
from rrnn_opt.claim import Claim, Range, Relation
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification.document import certificate_document

X, Y = Symbol.scalar("x"), Symbol.vector("y", 2)


x, y = X.sx, Y.sx


def claim(expression, sense="==0", **more) -> Claim:
    return Claim("T", "", "", (X, Y), Relation(expression, sense), **more)


def check(expression, sense="==0", *, method="identity", witness=None, **more):
    stated = claim(expression, sense, **more)
    return check_certificate(certificate_document(stated, method, witness=witness))


IDENTITY = (x + y[0]) ** 2 - x**2 - 2 * x * y[0] - y[0] ** 2 + ca.sin(y[1]) * 0.0


NONNEGATIVE = Range("x", (Fraction(0),), (None,))


POINT = {"x": (1,), "y": (Fraction(1, 3), -2)}
