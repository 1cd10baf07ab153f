"""C32: a path leads to a reachable point from every reachable point, Lemma 3.1."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.verification import ClaimCase, Mutation, Repair
from rrnn_opt.verification.vocabulary import (
    added,
    between,
    not_negative,
    scalars,
    stated,
)


def case(kinematics: Kinematics) -> ClaimCase:
    """No obstacle lies between two free postures of a prismatic joint in [-1, 1].

    The proof of the lemma takes a path from any x_s to x_d for granted.  For one
    prismatic joint with an obstacle at |q - o| <= a, every path from s to g
    passes all that is between them (intermediate values); so a path exists only
    if both are on one side, (s - o)(g - o) > 0.  The obstacle in the middle
    separates s = -1 from g = 1, both of which an arm can occupy.

    Args:
        kinematics: not used; the counterexample is an arm of its own.
    """
    s, g, o, a, t = scalars("s g o a t")
    start, goal = s.sx - o.sx, g.sx - o.sx
    free = ca.vertcat(start**2 - a.sx**2, goal**2 - a.sx**2)
    printed = Claim(
        id="C32",
        source="Lemma 3.1",
        statement="from every reachable x_s a path leads to x_d",
        variables=(s, g, o, a),
        goal=Relation(start * goal, ">0"),
        hypotheses=(stated("H1", "s and g are free", free, ">0"),),
        domain=(between(s, -1, 1), between(g, -1, 1), *not_negative(a)),
    )
    rest = 1 - t.sx
    above = ca.vertcat(start - a.sx, goal - a.sx)
    mended = Claim(
        id="C32",
        source="Lemma 3.1",
        statement="on one side of the obstacle the straight path is free",
        variables=(s, g, o, a, t),
        goal=Relation(rest * start + t.sx * goal - a.sx, ">=0"),
        hypotheses=(
            added("A1", "s and g are above the obstacle", above),
            stated("H1", "t goes from 0 to 1", ca.vertcat(t.sx, rest)),
        ),
        domain=(between(t, 0, 1),),
    )
    witness = {"s": (-1,), "g": (1,), "o": (0,), "a": (0.25,)}
    mutation = Mutation("both on one side", mended, holds=True)
    return ClaimCase(printed, mutation, (witness,), Repair(mended))
