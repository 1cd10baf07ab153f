"""C37: the proposed scheme is better than Method 3, Table II."""

from __future__ import annotations

from fractions import Fraction

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Mutation, Repair
from rrnn_opt.verification.vocabulary import pinned

PROPOSED = ("7/1000", "10/1000", "10/1000")
METHOD_3 = ("5/1000", "10/1000", "11/1000")


def case(kinematics: Kinematics) -> ClaimCase:
    """At no noise level of Table II is the proposed scheme's error the larger.

    It is at the least, 7 mm against 5 mm; equal at the middle one, and smaller
    at the largest, which is the repaired statement.

    Args:
        kinematics: not used; the table's own numbers are compared.
    """
    ours = Symbol.vector("proposed", 3, "m", "error at sigma = 0.01, 0.05, 0.25")
    theirs = Symbol.vector("method_3", 3, "m", "error at sigma = 0.01, 0.05, 0.25")
    printed, mended = (
        Claim(
            id="C37",
            source="Table II",
            statement=statement,
            variables=(ours, theirs),
            goal=Relation((theirs.sx - ours.sx)[rows], ">=0"),
            domain=(pinned(ours, PROPOSED), pinned(theirs, METHOD_3)),
        )
        for statement, rows in (
            ("the proposed scheme is at least as precise at every noise", [0, 1, 2]),
            ("it is at sigma = 0.05 and 0.25", [1, 2]),
        )
    )
    witness = {
        "proposed": tuple(map(Fraction, PROPOSED)),
        "method_3": tuple(map(Fraction, METHOD_3)),
    }
    mutation = Mutation("sigma = 0.05 and 0.25 only", mended, holds=True)
    return ClaimCase(printed, mutation, (witness,), Repair(mended))
