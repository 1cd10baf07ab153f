"""The claim that stands behind the longest step of ``LviPdnn``, and its proof."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

import casadi as ca

from rrnn_opt.claim import Claim, Hypothesis, Relation
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification.composite import Given, Proof, Square, Term

_BITS = 12
_INEQUALITY = (
    "with e = P_Z(y - F(y)) - y, d = y - y*: the projection and the solution give "
    "(y - F(y) - (y + e))'(e + d) >= 0 and F(y*)'(e + d) >= 0, whose sum is H1"
)


@dataclass(frozen=True)
class SafeStep:
    """Sizes and numbers of the claim; all numbers are dyadic and exact.

    With P = I, rows B and H = [[I, -B'], [B, 0]], one step is
    ``d + tau (I + H') e``, tau = h gamma.

    Attributes:
        n: unknowns.
        rows: equality and inequality rows together.
        square: s^2, upper bound of |B|^2.
        split: alpha > 0 in 2 a'b <= alpha |a|^2 + |b|^2 / alpha.
        tau: the longest step, h gamma.
    """

    n: int
    rows: int
    square: Fraction
    split: Fraction
    tau: Fraction

    @staticmethod
    def of(n: int, rows: int, square: float) -> SafeStep:
        """The longest step that the proof allows, to twelve bits.

        Args:
            n: unknowns.
            rows: equality and inequality rows together.
            square: upper bound of |B|^2.
        """
        s2 = Fraction(math.ceil(square * 2**_BITS), 2**_BITS)
        root = (3.0 + math.sqrt(9.0 + 4.0 * float(s2))) / 2.0
        split = Fraction(round(root * 2**_BITS), 2**_BITS)
        most = min(
            2 * split / (4 * split + s2 * (split + 1)),
            2 / (1 + s2 + split),
            Fraction(1),
        )
        tau = Fraction(math.floor(most * 2**_BITS), 2**_BITS)
        return SafeStep(n, rows, s2, split, tau)

    def proof(self) -> Proof:
        """No step up to tau goes away from a solution, whatever is active."""
        variables = du, _, eu, el, B = self._variables()
        claim = self._claim(variables)
        s2, split, tau = (ca.SX(float(x)) for x in (self.square, self.split, self.tau))
        Be = B.sx @ eu.sx
        free_u = split * 2 * tau - tau * tau * (4 * split + s2 * (split + 1))
        free_l = split * (2 * tau - tau * tau * (1 + s2 + split))
        terms: tuple[Term, ...] = (
            Given(0, 0, split * 2 * tau),
            Given(1, 0, tau * tau * (split + 1)),
            Given(2, 0, tau * tau * split),
            *(Square(x, split * 2 * tau) for x in ca.vertsplit(du.sx)),
            *(Square(x, free_u) for x in ca.vertsplit(eu.sx)),
            *(Square(x, free_l) for x in ca.vertsplit(el.sx)),
            *(Square(x, tau * tau) for x in ca.vertsplit(split * el.sx - Be)),
        )
        zero = {s.name: [0] * s.size for s in claim.variables}
        return Proof(claim, (), (terms,), (_INEQUALITY,), zero)

    def _variables(self) -> tuple[Symbol, ...]:
        """Distance y - y* and residual e of both parts of the state, and the rows."""
        n, r = self.n, self.rows
        du, eu = Symbol.vector("du", n), Symbol.vector("eu", n)
        dl, el = Symbol.vector("dl", r), Symbol.vector("el", r)
        return du, dl, eu, el, Symbol.matrix("B", (r, n))

    def _claim(self, variables: tuple[Symbol, ...]) -> Claim:
        du, dl, eu, el, B = variables
        s2, split, tau = (ca.SX(float(x)) for x in (self.square, self.split, self.tau))
        Be, Bt = B.sx @ eu.sx, B.sx.T @ el.sx
        step_u, step_l = 2 * eu.sx + Bt, el.sx - Be
        fall = -2 * tau * (ca.dot(du.sx, step_u) + ca.dot(dl.sx, step_l))
        fall -= tau * tau * (ca.sumsqr(step_u) + ca.sumsqr(step_l))
        toward_u = -(du.sx - B.sx.T @ dl.sx) - eu.sx
        toward_l = -(B.sx @ du.sx) - el.sx
        inequality = ca.dot(du.sx + eu.sx, toward_u) + ca.dot(dl.sx + el.sx, toward_l)
        rows = (
            Hypothesis("H1", "y* solves the programme", Relation(inequality, ">=0")),
            _bounded("A1", s2 * ca.sumsqr(eu.sx) - ca.sumsqr(Be)),
            _bounded("A2", s2 * ca.sumsqr(el.sx) - ca.sumsqr(Bt)),
        )
        return Claim(
            id="safe_step",
            source="B. He, Applied Mathematics and Optimization 35, 1997",
            statement=f"|y - y*|^2 does not grow in a step of LviPdnn with h gamma = "
            f"{float(self.tau)!r}, P = I and rows of norm {float(self.square)!r}^(1/2)",
            variables=variables,
            goal=Relation(split * fall, ">=0"),
            hypotheses=rows,
            order="discrete",
            jacobian="frozen",
        )


def _bounded(name: str, expression: ca.SX) -> Hypothesis:
    statement = "the rows B, whitened, are no longer than s"
    return Hypothesis(name, statement, Relation(expression, ">=0"), added=True)
