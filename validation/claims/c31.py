"""C31: the heuristic search is never starved, section II-D."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.networks import MemoryCell
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Given, Mutation, Proof
from rrnn_opt.verification.vocabulary import between, stated

MOST = 0.6414


def case(kinematics: Kinematics) -> ClaimCase:
    """At x = 0.6414 x' <= 0, at x = 0 x' >= 0, for A = 0.9, w = 0.95, I <= 1.

    So x stays in [0, 0.6414] once there (Nagumo), and a heuristic search, which
    is made with probability 1 - x, has at least 0.3586 however many collisions
    there are.  The mutation has inputs up to 2.

    Args:
        kinematics: not used.
    """
    return ClaimCase(_proof(1.0), Mutation("I up to 2", _proof(2.0)))


def _proof(most: float) -> Proof:
    cell, stimulus = MemoryCell(), Symbol.scalar("I", "1", "input")
    at_zero, at_most = (cell.derivative(ca.SX(x), stimulus.sx) for x in (0.0, MOST))
    claim = Claim(
        id="C31",
        source="section II-D",
        statement="the activity stays below 0.6414: heuristic searches go on",
        variables=(stimulus,),
        goal=Relation(ca.vertcat(at_zero, -at_most), ">=0"),
        hypotheses=(stated("H1", f"I <= {most:g}", most - stimulus.sx),),
        domain=(between(stimulus, 0, 2),),
        order="first-order",
    )
    terms = ((), (Given(0, 0, ca.SX(1 - MOST)),))
    return Proof(claim, (), terms, (), {"I": [0]})
