"""C34: in finite time the probability of a miss is 0, Theorem 3.1."""

from __future__ import annotations

from fractions import Fraction

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.verification import ClaimCase, Given, Mutation, Proof, Repair
from rrnn_opt.verification.vocabulary import (
    added,
    between,
    not_negative,
    scalars,
)

TRIES = 100


def case(kinematics: Kinematics) -> ClaimCase:
    """(1 - p)^100 <= 0 for a basin that one sample hits with probability p > 0.

    The chance that 100 independent samples all miss it.  p = 1/10 leaves
    (9/10)^100, about 2.7e-5.  What is true is that it tends to 0 with the number
    n of samples: m_n (1 + n p) <= 1, by induction.

    Args:
        kinematics: not used.
    """
    (p,) = scalars("p")
    printed = Claim(
        id="C34",
        source="Theorem 3.1",
        statement="after finitely many (100) samples the probability of a miss is 0",
        variables=(p,),
        goal=Relation((1 - p.sx) ** TRIES, "<=0"),
        domain=(between(p, "1/100", 1),),
    )
    mended = _limit()
    mutation = Mutation("it tends to 0", mended, holds=True)
    return ClaimCase(printed, mutation, ({"p": (Fraction(1, 10),)},), Repair(mended))


def _limit() -> Proof:
    """1 - m(1 - p)(1 + (n + 1)p) = 1 - m(1 + n p) + m (n + 1) p^2."""
    m, n, p = scalars("m n p")
    following = m.sx * (1 - p.sx)
    claim = Claim(
        id="C34",
        source="Theorem 3.1",
        statement="after n samples a miss has at most the probability 1/(1 + n p)",
        variables=(m, n, p),
        goal=Relation(1 - following * (1 + (n.sx + 1) * p.sx), ">=0"),
        hypotheses=(
            added("A1", "so it is after n samples", 1 - m.sx * (1 + n.sx * p.sx)),
            added("A2", "samples are independent, and hit a chain with p > 0"),
        ),
        domain=not_negative(m, n, p),
    )
    return Proof(
        claim, (), ((Given(0),),), ("induction over n",), {"m": [1], "n": [0], "p": [0]}
    )
