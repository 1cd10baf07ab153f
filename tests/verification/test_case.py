"""A case is refused when it is made, not ten seconds into its proof."""

import casadi as ca
import pytest

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.errors import ArgumentError
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Mutation, Repair

x = Symbol.scalar("x")
CLAIM = Claim("mine", "here", "x^2 >= 0", (x,), Relation(ca.power(x.sx, 2), ">=0"))


@pytest.mark.parametrize(
    "make",
    [
        lambda: Mutation(CLAIM, "words and claim are swapped"),
        lambda: ClaimCase("mine"),
        lambda: ClaimCase(CLAIM, CLAIM),
        lambda: Repair(None),
    ],
)
def test_arguments_of_another_kind(make):
    with pytest.raises(ArgumentError, match="expected"):
        make()


def test_a_case_of_the_right_kinds():
    assert ClaimCase(CLAIM, Mutation("the same", CLAIM, holds=True)).claim is CLAIM
