"""C33: the basins cover what is reachable, Lemma 3.2."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Mutation
from rrnn_opt.verification.vocabulary import between, scalars, stated


def case(kinematics: Kinematics) -> ClaimCase:
    """A point is in some basin exactly when it is reachable; by indicators.

    b_k says whether the point lies in basin k, r whether it is reachable.  A
    basin is a subset of what is reachable (b_k <= r), and a reachable point lies
    in its own basin (b_1 >= r); then max b = r.  Written for three basins, the
    point's own and two others; more add terms of the same kind to the maximum.
    (So B_d = {x_d} would do: the lemma says nothing of the size of basins.)

    Args:
        kinematics: not used.
    """
    b, r = Symbol.vector("b", 3), scalars("r")[0]
    union = ca.mmax(b.sx)
    subset = stated("H1", "basins are parts of what is reachable", r.sx - b.sx)
    own = stated("H2", "a reachable point is in its own basin", b.sx[0] - r.sx)
    claim, variant = (
        Claim(
            id="C33",
            source="Lemma 3.2",
            statement="the union of all basins is what is reachable",
            variables=(b, r),
            goal=Relation(union - r.sx, "==0"),
            hypotheses=hypotheses,
            domain=(between(b, 0, 1), between(r, 0, 1)),
        )
        for hypotheses in ((subset, own), (subset,))
    )
    example = {"b": (1, 0, 0), "r": (1,)}
    mutation = Mutation("points outside their own basin", variant)
    return ClaimCase(claim, mutation, example=example)
