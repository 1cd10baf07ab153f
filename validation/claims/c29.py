"""C29: the activity of the memory cell (14) stays in [0, 1]."""

from __future__ import annotations

from fractions import Fraction

import casadi as ca

from rrnn_opt.claim import Claim, Range, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Mutation


def case(kinematics: Kinematics) -> ClaimCase:
    """(14) does not point out of [0, 1] at either end.

        x' = -A x + (1 - x) (I + w max(x, 0)),   A >= 0, I >= 0, any w

    x' >= 0 at x = 0 and x' <= 0 at x = 1; by Nagumo's theorem that is what
    invariance of [0, 1] means for a Lipschitz field.

    The mutation lets the input be negative.

    Args:
        kinematics: not used.
    """
    claim = _claim(Fraction(0))
    variant = _claim(Fraction(-1))
    return ClaimCase(claim, Mutation("I >= -1 in place of I >= 0", variant))


def _claim(least_input: Fraction) -> Claim:
    decay = Symbol.scalar("A", "1", "decay rate")
    excitation = Symbol.scalar("w", "1", "self-excitation")
    stimulus = Symbol.scalar("I", "1", "input")

    def rate(x: float) -> ca.SX:
        drive = stimulus.sx + excitation.sx * max(x, 0.0)
        return -decay.sx * x + (1.0 - x) * drive

    return Claim(
        id="C29",
        source="eq. (14)",
        statement="x' >= 0 at x = 0 and x' <= 0 at x = 1, which is that [0, 1] is "
        "invariant (Nagumo)",
        variables=(decay, excitation, stimulus),
        goal=Relation(ca.vertcat(rate(0.0), -rate(1.0)), ">=0"),
        domain=(
            Range("A", (Fraction(0),), (None,)),
            Range("I", (least_input,), (None,)),
        ),
        order="first-order",
    )
