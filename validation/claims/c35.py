"""C35: the chance of success after n iterations, Theorem 3.2."""

from __future__ import annotations

from fractions import Fraction
from itertools import product
from math import comb

import casadi as ca

from rrnn_opt.claim import Claim, Hypothesis, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Mutation, Proof
from rrnn_opt.verification.vocabulary import added, pinned

TRIALS, CHAINS = (5, 10, 20, 50, 100, 200), range(1, 9)
CHANCES = tuple(Fraction(k, 10) for k in range(1, 10))
RULE = "for every n, k and p the inequality is the lower Chernoff bound"


def case(kinematics: Kinematics) -> ClaimCase:
    """P(L < k) <= exp(k - n p/2) for L binomial of n and p, on a grid.

    n in 5 .. 200, k in 1 .. 8, p in 1/10 .. 9/10: 432 triples, the sum exact up
    to the exponential, which is a ball.  That is the bound of the theorem; in
    its proof (22a) names the wrong parameters, the exponent lacks its sign, and
    (23a) is the negative of what it expands.  The mutation drops the factor 1/2.

    Args:
        kinematics: not used.
    """
    claim = _grid(0.5, (added("A1", "trials are independent, each succeeds with p"),))
    proof = Proof(claim, (claim,), (), (RULE,), {"p": CHANCES})
    return ClaimCase(proof, Mutation("exp(k - n p)", _grid(1.0, ())))


def _grid(share: float, hypotheses: tuple[Hypothesis, ...]) -> Claim:
    """exp(k - share n p) - sum over i < k of (n over i) p^i (1 - p)^(n - i)."""
    p = Symbol.vector("p", len(CHANCES), "1", "chance of one trial")
    gaps = [
        ca.exp(k - share * n * p.sx[j]) - _below(n, k, p.sx[j])
        for n, k, j in product(TRIALS, CHAINS, range(len(CHANCES)))
    ]
    return Claim(
        id="C35",
        source="Theorem 3.2",
        statement="P(success in n iterations) >= 1 - exp((2k - n p)/2)",
        variables=(p,),
        goal=Relation(ca.vertcat(*gaps), ">=0"),
        hypotheses=hypotheses,
        domain=(pinned(p, CHANCES),),
    )


def _below(n: int, k: int, p: ca.SX) -> ca.SX:
    """P(L < k)."""
    terms = (comb(n, i) * p**i * (1 - p) ** (n - i) for i in range(min(k, n + 1)))
    return ca.sum1(ca.vertcat(*terms))
