"""C6: the fixed points (5) are the optima of (3)."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Given, Instance, Mutation, Proof
from rrnn_opt.verification.lemmas import projection
from rrnn_opt.verification.vocabulary import Programme, added, stated

JOINTS, ROWS = 7, 3


def case(kinematics: Kinematics) -> ClaimCase:
    """If (u, lam) solves (5), no feasible y is cheaper; 7 joints and 3 rows.

        f(y) - f(u) - (y - u)'W(y - u) = sum_i g_i (y_i - u_i) >= 0,  g = dL/du

    since J(y - u) = 0.  Each g_i (y_i - u_i) is one scalar lemma on the
    projection.  With W not negative the left side is at most f(y) - f(u).  That
    every optimum has such a multiplier is the duality of convex programmes.

    Args:
        kinematics: not used; the statement is about any Jacobian.
    """
    p = Programme.of(JOINTS, ROWS)
    y = Symbol.vector("y", JOINTS, "rad/s", "feasible velocity")
    u, lam, gap = p.u.sx, p.lam.sx, y.sx - p.u.sx
    claim = Claim(
        id="C6",
        source="eq. (4)-(5)",
        statement="a fixed point (5) is an optimum of (3), and the reverse: "
        "f(y) - f(u) >= (y - u)'W(y - u)",
        variables=(*p.symbols, y),
        goal=Relation(p.cost(y.sx) - p.cost(u) - gap.T @ p.weight @ gap, ">=0"),
        hypotheses=(
            stated("H1", "u solves (5)", p.projected(u, lam) - u, "==0"),
            stated("H2", "J u = rd_dot", p.rows(u), "==0"),
            stated("H3", "y satisfies (3b)", p.rows(y.sx), "==0"),
            stated("H4", "y satisfies (3c)", p.inside(y.sx)),
            added("A1", "W is positive semidefinite, Omega a box, (3) feasible"),
        ),
    )
    proof = Proof(
        claim,
        (projection(),),
        (_terms(p, y.sx),),
        ("a convex programme with linear constraints has multipliers (duality)",),
        _still(p),
    )
    return ClaimCase(proof, Mutation("(3b) not asked of u", _unfed()))


def _terms(p: Programme, y: ca.SX) -> tuple[Instance | Given, ...]:
    """g'(y - u) by coordinates; lam'(J u - rd_dot) and lam'(rd_dot - J y) vanish."""
    u, lam = p.u.sx, p.lam.sx
    drive = u - p.gradient(u, lam)
    joints = tuple(
        Instance(
            0,
            {
                "x": drive[i],
                "s": u[i],
                "y": y[i],
                "low": p.low.sx[i],
                "high": p.high.sx[i],
            },
        )
        for i in range(JOINTS)
    )
    return joints + tuple(
        Given(h, k, sign * lam[k]) for h, sign in ((1, 1), (2, -1)) for k in range(ROWS)
    )


def _still(p: Programme) -> dict[str, list[int]]:
    point = {s.name: [0] * s.size for s in p.symbols} | {"y": [0] * JOINTS}
    return point | {"low": [-1] * JOINTS, "high": [1] * JOINTS}


def _unfed() -> Claim:
    """One joint and one row, without asking that u satisfies it."""
    p, y = Programme.of(1, 1), Symbol.vector("y", 1)
    rest = p.projected(p.u.sx, p.lam.sx) - p.u.sx
    return Claim(
        id="C6",
        source="eq. (5)",
        statement="the first line of (5) alone makes an optimum",
        variables=(*p.symbols, y),
        goal=Relation(p.cost(y.sx) - p.cost(p.u.sx), ">=0"),
        hypotheses=(
            stated("H1", "u solves the first line of (5)", rest, "==0"),
            stated("H3", "y satisfies (3b)", p.rows(y.sx), "==0"),
            stated("H4", "y satisfies (3c)", p.inside(y.sx)),
            added("A1", "W is positive definite", p.w.sx, ">0"),
        ),
    )
