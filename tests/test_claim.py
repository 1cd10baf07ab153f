import dataclasses
from fractions import Fraction

import casadi as ca
import pytest

from rrnn_opt.claim import Claim, Hypothesis, Range, Relation
from rrnn_opt.errors import RrnnError, ShapeError
from rrnn_opt.symbolic import Symbol

x = Symbol.vector("x", 2)
w = Symbol.scalar("w")


def make(**changes):
    parts = {
        "id": "C20a",
        "source": "eq. (21)",
        "statement": "x P(x) is not negative",
        "variables": (x, w),
        "goal": Relation(x.sx * ca.fmin(x.sx, w.sx), ">=0"),
        "hypotheses": (
            Hypothesis("A1", "0 in Omega", Relation(w.sx, ">=0")),
            Hypothesis("A2", "the robot is rigid"),
        ),
        "domain": (Range("w", (Fraction(1, 10),), (None,)),),
        "order": "first-order",
        "jacobian": "frozen",
    }
    return Claim(**(parts | changes))


def test_the_graph_holds_goal_and_hypotheses():
    claim = make()
    f = claim.function()
    assert [f.name_in(i) for i in range(f.n_in())] == ["x", "w"]
    assert [f.name_out(i) for i in range(f.n_out())] == ["goal", "hypothesis_1"]
    assert [r.sense for r in claim.relations] == [">=0", ">=0"]
    goal, hypothesis = f([-1, 3], 2)
    assert [float(goal[0]), float(goal[1]), float(hypothesis)] == [1.0, 6.0, 2.0]


def test_fingerprint_is_of_what_is_claimed():
    claim = make()
    assert claim.fingerprint == make().fingerprint
    words = dataclasses.replace(claim, id="X", source="", statement="")
    assert words.fingerprint == claim.fingerprint
    changes = [
        {"goal": Relation(x.sx * ca.fmin(x.sx, w.sx), ">0")},
        {"goal": Relation(x.sx * ca.fmax(x.sx, w.sx), ">=0")},
        {"hypotheses": ()},
        {"hypotheses": (Hypothesis("A1", "", Relation(w.sx, ">0")),)},
        {"domain": ()},
        {"domain": (Range("w", (Fraction(1, 9),), (None,)),)},
        {"domain": (Range("w", (None,), (Fraction(1, 10),)),)},
        {"order": "second-order"},
        {"jacobian": "moving"},
    ]
    prints = {make(**change).fingerprint for change in changes}
    assert len(prints) == len(changes)
    assert claim.fingerprint not in prints


@pytest.mark.parametrize(
    ("changes", "text"),
    [
        ({"order": "third"}, "order 'third'"),
        ({"jacobian": "slow"}, "'slow'"),
        ({"variables": (x,)}, "goal: depends on w"),
        ({"variables": (x, w, w)}, "two symbols are called 'w'"),
        ({"domain": (Range("z", (), ()),)}, "no variable 'z'"),
        (
            {"hypotheses": (Hypothesis("A1", "", Relation(ca.SX.sym("y"), ">0")),)},
            "hypothesis A1: depends on y",
        ),
    ],
)
def test_mistakes_are_named(changes, text):
    with pytest.raises(RrnnError, match=text):
        make(**changes)


def test_relations_and_ranges_are_checked():
    with pytest.raises(RrnnError, match="use one of"):
        Relation(x.sx, "=0")
    with pytest.raises(RrnnError, match="empty"):
        Relation(ca.SX(0, 1), ">0")
    with pytest.raises(ShapeError, match="upper bounds"):
        Range("x", (None,), ())
    with pytest.raises(RrnnError, match="1 exceeds 0"):
        Range("x", (Fraction(1),), (Fraction(0),))
    with pytest.raises(ShapeError, match="range of 'x'"):
        make(domain=(Range("x", (None,), (None,)),))
    assert Relation(x.sx, "<0").strict
    assert not Relation(x.sx, "<=0").strict
