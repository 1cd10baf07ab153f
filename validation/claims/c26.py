"""C26: the sets (12) keep critical points off the obstacle."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Given, Mutation, Proof, Repair
from rrnn_opt.verification.vocabulary import stated


def case(kinematics: Kinematics) -> ClaimCase:
    """(r - o)'J q' >= 0 for q' in (12): planar arm of two links of 1 m.

    (12) bounds joint i by the sign of component i of the escape velocity, as
    its index says.  With the arm up (q = (3/2, 0)) and the obstacle to the left,
    the escape goes along +x, so joint 1 may turn forwards, which carries the tip
    along -x, into the obstacle.  With the sign of (J'(r - o))_j in place of that
    of (r - o)_j the statement is true for any arm; it is a sum of hypotheses.

    Args:
        kinematics: not used; the counterexample is an arm of its own.
    """
    q = Symbol.vector("q", 2, "rad")
    gap, u = Symbol.vector("gap", 2, "m", "r - o"), Symbol.vector("u", 2, "rad/s")
    angle = q.sx[0] + q.sx[1]
    tip = ca.vertcat(ca.cos(q.sx[0]) + ca.cos(angle), ca.sin(q.sx[0]) + ca.sin(angle))
    allowed = ca.if_else(gap.sx < 0, -u.sx, u.sx)
    printed = Claim(
        id="C26",
        source="eq. (12)",
        statement="joint velocities in (12) do not bring a critical point nearer",
        variables=(q, gap, u),
        goal=Relation(ca.dot(gap.sx, ca.jtimes(tip, q.sx, u.sx)), ">=0"),
        hypotheses=(stated("H1", "u lies in (12)", allowed),),
        order="first-order",
        jacobian="moving",
    )
    witness = {"q": (1.5, 0), "gap": (1, 0), "u": (1, 0)}
    mended = _transposed(7)
    mutation = Mutation("signs of J'(r - o)", mended, holds=True)
    return ClaimCase(printed, mutation, (witness,), Repair(mended))


def _transposed(n: int) -> Proof:
    """(r - o)'J u = sum of u_j (J'(r - o))_j."""
    J, gap = Symbol.matrix("J", (3, n), "m/rad"), Symbol.vector("gap", 3, "m", "r - o")
    u = Symbol.vector("u", n, "rad/s")
    each = u.sx * (J.sx.T @ gap.sx)
    claim = Claim(
        id="C26",
        source="eq. (12)",
        statement="velocities with u_j (J'(r - o))_j >= 0 bring no point nearer",
        variables=(J, gap, u),
        goal=Relation(ca.dot(gap.sx, J.sx @ u.sx), ">=0"),
        hypotheses=(stated("H1", "each joint does no harm", each),),
        order="first-order",
        jacobian="moving",
    )
    terms = tuple(Given(0, j) for j in range(n))
    return Proof(claim, (), (terms,), (), {s.name: [0] * s.size for s in (J, gap, u)})
