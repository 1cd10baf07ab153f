"""C29': the activity of the memory cell (14) stays in [0, 1], in Euler steps."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.verification import ClaimCase, Mutation
from rrnn_opt.verification.vocabulary import (
    added,
    between,
    not_negative,
    scalars,
)


def case(kinematics: Kinematics) -> ClaimCase:
    """0 <= x + h x' <= 1 for 0 <= x <= 1, if h A <= 1 and h (I + w) <= 1.

    With h = 1, A = 0.9, w = 0.95 and I = 1, x = 1/20 goes to 8001/8000: that is
    what the mutation allows.

    Args:
        kinematics: not used.
    """
    x, A, w, stimulus, h = scalars("x A w I h")
    drive = stimulus.sx + w.sx * ca.fmax(x.sx, 0)
    then = x.sx + h.sx * (-A.sx * x.sx + (1 - x.sx) * drive)
    decay = added("A1", "h A <= 1", 1 - h.sx * A.sx)
    gain = added("A2", "h (I + w) <= 1", 1 - h.sx * (stimulus.sx + w.sx))
    claim, variant = (
        Claim(
            id="C29p",
            source="eq. (14)",
            statement="an Euler step of (14) keeps the activity in [0, 1]",
            variables=(x, A, w, stimulus, h),
            goal=Relation(ca.vertcat(then, 1 - then), ">=0"),
            hypotheses=hypotheses,
            domain=(between(x, 0, 1), *not_negative(A, w, stimulus, h)),
            order="discrete",
        )
        for hypotheses in ((decay, gain), (decay,))
    )
    example = {"x": (0,), "A": (1,), "w": (0.5,), "I": (0.5,), "h": (1,)}
    return ClaimCase(claim, Mutation("h (I + w) of any size", variant), example=example)
