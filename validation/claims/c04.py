"""C4: a real symmetric W makes (3) a programme with a solution."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Mutation, Repair
from rrnn_opt.verification.vocabulary import Programme, added, stated


def case(kinematics: Kinematics) -> ClaimCase:
    """(3) is well posed for every symmetric W: feasible, and convex on its rows.

    Read with two joints and one row as two necessary conditions.  Feasible: by
    the lemma of Farkas {J u = rd_dot, u in Omega} is empty exactly when some y
    has y rd_dot > max over Omega of y J u; so y rd_dot <= that maximum for
    every y.  Convex: d'W d >= 0 for every d with J d = 0.  One point breaks
    both.  What is true is that a convex programme has at most one optimum.

    Args:
        kinematics: not used; the statement is about any Jacobian.
    """
    p = Programme.of(2, 1)
    y, d = Symbol.scalar("y"), Symbol.vector("d", 2)
    along = ca.vec(p.J.sx) * y.sx
    most = ca.sum1(ca.fmax(along * p.low.sx, along * p.high.sx))
    bend = d.sx.T @ p.weight @ d.sx
    printed = Claim(
        id="C4",
        source="eq. (3)",
        statement="(3) with any symmetric W and any rd_dot has a solution",
        variables=(p.w, p.J, p.rate, p.low, p.high, y, d),
        goal=Relation(ca.vertcat(most - y.sx * p.rate.sx, bend), ">=0"),
        hypotheses=(
            stated("H1", "Omega is not empty", p.high.sx - p.low.sx),
            stated("H2", "d moves along the rows", p.J.sx @ d.sx, "==0"),
        ),
    )
    witness = {
        "w": (1, 0, -1), "J": (1, 0), "rd_dot": (2,), "low": (-1, -1), "high": (1, 1),
        "y": (1,), "d": (0, 1),
    }  # fmt: skip
    mended = _unique(p)
    mutation = Mutation("midpoints of a convex programme", mended, holds=True)
    return ClaimCase(printed, mutation, (witness,), Repair(mended))


def _unique(p: Programme) -> Claim:
    """Halfway between two points the cost is lower by (a - b)'W(a - b) / 4."""
    a, b = Symbol.vector("a", 2), Symbol.vector("b", 2)
    gap = a.sx - b.sx
    middle = (p.cost(a.sx) + p.cost(b.sx)) / 2 - p.cost((a.sx + b.sx) / 2)
    return Claim(
        id="C4",
        source="eq. (3)",
        statement="a feasible (3) has one optimum at most: halfway between a and b "
        "the cost is lower than its mean by (a - b)'W(a - b)/4",
        variables=(p.w, p.c, a, b),
        goal=Relation(middle - gap.T @ p.weight @ gap / 4, "==0"),
        hypotheses=(added("A1", "W is positive definite, (3) feasible"),),
    )
