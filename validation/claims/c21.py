"""C21: the error converges to zero from every posture ("globally")."""

from __future__ import annotations

from fractions import Fraction

import casadi as ca

from rrnn_opt.claim import Claim, Range, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.verification import ClaimCase, Mutation, Repair
from rrnn_opt.verification.document import Witness
from rrnn_opt.verification.lemmas import clip
from rrnn_opt.verification.vocabulary import (
    not_negative,
    scalars,
    stated,
)

GAIN, SPEED, DECAY = 10.0, 1.0, 0.5


def case(kinematics: Kinematics) -> ClaimCase:
    """Where the law (18) rests with a regular J and a target in reach, e = 0.

    If every motion ended at e = 0, no posture with e not 0 could be at rest.
    Planar arm of two links of 1 m, angles as pairs (c, s) on the unit circle
    (so that postures are rational); k >= 0 is how far joint 1 is below its
    upper limit, which bounds its velocity by c_2 k (10).  Stretched along x and
    bent down by 90 degrees, at the limit, with the target 0.1 m above the tip,
    joint 1 wants to go up and may not, joint 2 gains nothing.  The repaired
    statement says that this trap has a volume.

    Args:
        kinematics: not used; the counterexample is an arm of its own.
    """
    c1, s1, c2, s2, k, x, y = scalars("c1 s1 c2 s2 k x y")
    tip, J = _arm(c1.sx, s1.sx, c2.sx, s2.sx)
    e = ca.vertcat(x.sx, y.sx) - tip
    high = ca.vertcat(ca.fmin(DECAY * k.sx, SPEED), SPEED)
    velocity = clip(GAIN * (J.T @ e), ca.SX([-SPEED, -SPEED]), high)
    det = J[0, 0] * J[1, 1] - J[0, 1] * J[1, 0]
    circles = ca.vertcat(c1.sx**2 + s1.sx**2 - 1, c2.sx**2 + s2.sx**2 - 1)
    printed = Claim(
        id="C21",
        source="section III-A",
        statement="the scheme converges to e = 0 from every posture",
        variables=(c1, s1, c2, s2, k, x, y),
        goal=Relation(e, "==0"),
        hypotheses=(
            stated("H1", "(c, s) are cosines and sines", circles, "==0"),
            stated("H2", "the arm is at rest under (18)", velocity, "==0"),
            stated("H3", "J is regular", det**2, ">0"),
            stated("H4", "the target is in reach", 4 - x.sx**2 - y.sx**2),
        ),
        domain=not_negative(k),
        order="first-order",
        jacobian="moving",
    )
    witness: Witness = {
        "c1": (1,), "s1": (0,), "c2": (0,), "s2": (-1,), "k": (0,), "x": (1,),
        "y": (Fraction(-9, 10),),
    }  # fmt: skip
    mended = _trap()
    mutation = Mutation("a box that is never left", mended, holds=True)
    return ClaimCase(printed, mutation, (witness,), Repair(mended))


def _arm(c1: ca.SX, s1: ca.SX, c2: ca.SX, s2: ca.SX) -> tuple[ca.SX, ca.SX]:
    """Tip and Jacobian of two links of 1 m, m and m/rad."""
    c12, s12 = c1 * c2 - s1 * s2, s1 * c2 + c1 * s2
    tip = ca.vertcat(c1 + c12, s1 + s12)
    return tip, ca.vertcat(ca.horzcat(-tip[1], -s12), ca.horzcat(tip[0], c12))


def _trap() -> Claim:
    """The field points into q1 in [-0.02, 0], q2 in [-1.62, -1.52] on its faces.

    Joint 1 pushes upwards in the whole box, and stops at its limit q1 = 0; joint
    2 turns back at both of its faces; |e|^2 > 0.0049 and det J = sin(q2) < 0 in
    the whole box.
    """
    q1, q2 = scalars("q1 q2")

    def drive(a: ca.SX, b: ca.SX) -> tuple[ca.SX, ca.SX, ca.SX]:
        s1, s12, k1, k12 = ca.sin(a), ca.sin(a + b), ca.cos(a), ca.cos(a + b)
        ex, ey = 1.0 - k1 - k12, -0.9 - s1 - s12
        first = -(s1 + s12) * ex + (k1 + k12) * ey
        return first, -s12 * ex + k12 * ey, ex**2 + ey**2

    lowest, highest = -1.62, -1.52
    first, _, size = drive(q1.sx, q2.sx)
    below, above = drive(q1.sx, ca.SX(lowest))[1], drive(q1.sx, ca.SX(highest))[1]
    return Claim(
        id="C21",
        source="section III-A",
        statement="a box of postures with regular J and |e| > 0.07 that (18) never "
        "leaves: the field points inwards on its faces",
        variables=(q1, q2),
        goal=Relation(
            ca.vertcat(first, below, -above, size - 0.0049, -ca.sin(q2.sx)), ">0"
        ),
        domain=(
            Range("q1", (Fraction(-1, 50),), (Fraction(0),)),
            Range("q2", (Fraction(lowest),), (Fraction(highest),)),
        ),
        order="first-order",
        jacobian="moving",
    )
