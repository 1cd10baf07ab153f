"""C21': what (18) does converge to, inside the joint limits."""

from __future__ import annotations

from rrnn_opt.robot import Kinematics
from rrnn_opt.verification import ClaimCase, Mutation
from rrnn_opt.verification.catalogue import reduced_law_decreases


def case(kinematics: Kinematics) -> ClaimCase:
    """V' <= -epsilon |q'|^2 along (18) with the box (10), q inside its limits.

    V' is differentiated through the forward kinematics of the robot, J moves
    with q, and one scalar lemma a joint does the rest.  So q' tends to 0, and
    the arm to postures with J'e in the normal cone of Omega(q) at 0.  The
    mutation lets the posture be anywhere.

    Args:
        kinematics: kinematics of the robot.
    """
    proof = reduced_law_decreases(kinematics, name="C21p")
    loose = reduced_law_decreases(kinematics, name="C21p", inside=False)
    return ClaimCase(proof, Mutation("q anywhere", loose))
