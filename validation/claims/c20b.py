"""C20b: e = 0 is the only solution of V' = 0, below (21)."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.validation.claims.reduced import Reduced
from rrnn_opt.verification import ClaimCase, Given, Instance, Mutation, Proof, Repair
from rrnn_opt.verification.composite import Term
from rrnn_opt.verification.lemmas import slack
from rrnn_opt.verification.vocabulary import (
    added,
    not_negative,
    scalars,
    stated,
)


def case(kinematics: Kinematics) -> ClaimCase:
    """V' = 0 implies e = 0 for a planar arm of two links of 1 m, 0 inside Omega.

    Straight along x, J'e = 0 for every e along x, so V' = 0 and the arm stays.
    The repaired statement is quantitative: where |J's| is at least sigma |s|
    and bounds leave a share k of every drive, V' <= -alpha V.

    Args:
        kinematics: not used; the counterexample is an arm of its own.
    """
    q1, q2, ex, ey, low, high = scalars("q1 q2 ex ey low high")
    s1, s12 = ca.sin(q1.sx), ca.sin(q1.sx + q2.sx)
    c1, c12 = ca.cos(q1.sx), ca.cos(q1.sx + q2.sx)
    x1 = -(s1 + s12) * ex.sx + (c1 + c12) * ey.sx
    x2 = -s12 * ex.sx + c12 * ey.sx
    p1, p2 = (ca.fmin(ca.fmax(x, low.sx), high.sx) for x in (x1, x2))
    error = ca.vertcat(ex.sx, ey.sx)
    printed = Claim(
        id="C20b",
        source="eq. (21), LaSalle",
        statement="V' = 0 only where e = 0",
        variables=(q1, q2, ex, ey, low, high),
        goal=Relation(error, "==0"),
        hypotheses=(
            stated("H1", "V' = 0", x1 * p1 + x2 * p2, "==0"),
            stated("H2", "0 lies inside Omega", ca.vertcat(-low.sx, high.sx), ">0"),
        ),
        order="first-order",
        jacobian="moving",
    )
    witness = {
        "q1": (0,), "q2": (0,), "ex": (-1,), "ey": (0,), "low": (-1,), "high": (1,)
    }  # fmt: skip
    mended = quantitative(7, 3, "C20b")
    mutation = Mutation("full rank and slack bounds", mended, holds=True)
    return ClaimCase(printed, mutation, (witness,), Repair(mended))


def quantitative(n: int, m: int, name: str) -> Proof:
    """V' <= -alpha V, alpha = 2 k sigma^2/epsilon, by one lemma a joint.

    -V'/epsilon = x'P(x) >= k |x|^2 >= k sigma^2 |s|^2 with x = J's, and
    V = epsilon^2 |s|^2/2.  With |x_i| <= X and bounds at least delta away from
    0, k = min(1, delta/X).

    Args:
        n: joints.
        m: rows.
        name: id of the claim.
    """
    law = Reduced.of(n, m)
    k, sigma = scalars("k sigma")
    x, size = law.x, ca.dot(law.s.sx, law.s.sx)
    rank = ca.dot(x, x) - sigma.sx**2 * size
    share = ca.vertcat(k.sx * x - law.low.sx, law.high.sx - k.sx * x)
    claim = Claim(
        id=name,
        source="eq. (18)-(21)",
        statement="V' <= -alpha V with alpha = 2 k sigma^2/epsilon",
        variables=(*law.symbols, k, sigma),
        goal=Relation(law.fall - k.sx * sigma.sx**2 * size, ">=0"),
        hypotheses=(
            added("A1", "the smallest singular value of J is at least sigma", rank),
            added("A2", "the share k of every J'e/epsilon lies in Omega", share),
            added("A3", "0 <= k <= 1", ca.vertcat(k.sx, 1 - k.sx)),
        ),
        domain=not_negative(k),
        order="first-order",
        jacobian="moving",
    )
    joints = tuple(
        Instance(
            0,
            {"x": x[i], "k": k.sx, "low": law.low.sx[i], "high": law.high.sx[i]},
        )
        for i in range(n)
    )
    terms: tuple[Term, ...] = (*joints, Given(0, 0, k.sx))
    example = law.example() | {"k": [1], "sigma": [0]}
    return Proof(claim, (slack(),), (terms,), example=example)
