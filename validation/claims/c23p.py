"""C23': the box (10) keeps the joints inside, in Euler steps."""

from __future__ import annotations

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.verification import ClaimCase, Given, Mutation, Proof
from rrnn_opt.verification.vocabulary import (
    added,
    not_negative,
    scalars,
    stated,
)


def case(kinematics: Kinematics) -> ClaimCase:
    """The step x - h v is >= 0 for x = q+ - q >= 0 and v <= c x, if h c <= 1.

        x - h v = x (1 - h c) + h (c x - v)

    The mutation takes h c <= 5/4.

    Args:
        kinematics: not used; the statement is about any joint.
    """
    x, v, c, h = scalars("x v c h")
    claim, variant = (
        Claim(
            id="C23p",
            source="eq. (10)",
            statement="an Euler step of the first-order law keeps q below q+",
            variables=(x, v, c, h),
            goal=Relation(x.sx - h.sx * v.sx, ">=0"),
            hypotheses=(
                stated("H1", "q' <= d+ <= c x", c.sx * x.sx - v.sx),
                added("A1", f"h c <= {most}", most - h.sx * c.sx),
            ),
            domain=not_negative(x, c, h),
            order="discrete",
        )
        for most in (1, 1.25)
    )
    terms = (Given(1, 0, x.sx), Given(0, 0, h.sx))
    example = {"x": [1], "v": [0], "c": [1], "h": [1]}
    proof = Proof(claim, (), (terms,), (), example)
    return ClaimCase(proof, Mutation("h c <= 5/4", variant))
