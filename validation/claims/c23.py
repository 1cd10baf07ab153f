"""C23: the box (10) keeps the joints inside their limits."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.verification import ClaimCase, Given, Mutation, Proof, Repair
from rrnn_opt.verification.document import Witness
from rrnn_opt.verification.lemmas import clip
from rrnn_opt.verification.vocabulary import (
    added,
    not_negative,
    scalars,
    stated,
)


def case(kinematics: Kinematics) -> ClaimCase:
    """Under (6a), q' <= beta x is kept, x = q+ - q, so x' = -q' >= -beta x.

    (6a) says epsilon q'' = P - q' with P <= d+ <= c x.  On the edge v = beta x
    of the cone, epsilon (beta x - v)' = -epsilon beta v + v - P is not
    negative, if epsilon beta^2 - beta + c = 0.  A real beta is there only for
    4 epsilon c <= 1; the mutation takes that for granted.  The paper gives
    c = 0.5 and no epsilon.  Under the first-order law the limits hold as they
    stand, which is the repaired statement.

    Args:
        kinematics: not used; the statement is about any joint.
    """
    x, v, P, c, beta, epsilon = scalars("x v P c beta epsilon")
    root = epsilon.sx * beta.sx**2 - beta.sx + c.sx
    claim = Claim(
        id="C23",
        source="eq. (6a), (10)",
        statement="(10) keeps q below q+ under (6a): the cone q' <= beta x is kept",
        variables=(x, v, P, c, beta, epsilon),
        goal=Relation(-epsilon.sx * beta.sx * v.sx + v.sx - P.sx, ">=0"),
        hypotheses=(
            stated("H1", "P <= d+ <= c x", c.sx * x.sx - P.sx),
            stated("H2", "on the edge: q' = beta x", v.sx - beta.sx * x.sx, "==0"),
            added(
                "A1", "4 epsilon c <= 1: beta solves eps b^2 - b + c = 0", root, "==0"
            ),
            added("A2", "q'(0) <= beta (q+ - q(0))"),
        ),
        domain=not_negative(x, c, epsilon),
        order="second-order",
    )
    terms = (Given(0), Given(1, 0, 1 - epsilon.sx * beta.sx), Given(2, 0, -x.sx))
    rule = "Nagumo: a set that a Lipschitz field does not leave at its edge is kept"
    values = {"x": 1, "v": 0.5, "P": 0, "c": 0.25, "beta": 0.5, "epsilon": 1}
    example: Witness = {name: [value] for name, value in values.items()}
    proof = Proof(claim, (), (terms,), (rule,), example)
    mutation = Mutation("4 epsilon c of any size", _any_size())
    return ClaimCase(proof, mutation, (), Repair(_first_order()))


def _any_size() -> Claim:
    """The discriminant of eps b^2 - b + c is not negative, whatever eps and c are."""
    c, epsilon = scalars("c epsilon")
    return Claim(
        "C23",
        "eq. (10)",
        "a real beta is there for every epsilon and c",
        (c, epsilon),
        Relation(1 - 4 * epsilon.sx * c.sx, ">=0"),
        domain=not_negative(c, epsilon),
    )


def _first_order() -> Claim:
    """On the interval (10) q' = P(drive) is at most c x: (x exp(c t))' >= 0."""
    x, drive, low, fastest, c = scalars("x drive low w_high c")
    velocity = clip(drive.sx, low.sx, ca.fmin(c.sx * x.sx, fastest.sx))
    return Claim(
        id="C23",
        source="eq. (10), (18)",
        statement="under the first-order law x' + c x >= 0, whatever drives it: "
        "(x exp(c t))' >= 0",
        variables=(x, drive, low, fastest, c),
        goal=Relation(-velocity + c.sx * x.sx, ">=0"),
        order="first-order",
    )
