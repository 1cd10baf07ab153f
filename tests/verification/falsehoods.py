"""Statements that are false, most by a hair."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import casadi as ca

import rrnn_opt as rr
from rrnn_opt.claim import Claim, Hypothesis, Relation
from rrnn_opt.decay import DecayClaim
from rrnn_opt.symbolic import Symbol
from rrnn_opt.validation.claims import case
from rrnn_opt.verification import Given, Instance, Proof, Square, lemmas
from rrnn_opt.verification.energy import Frozen, decrease
from rrnn_opt.verification.lemmas import clip
from rrnn_opt.verification.vocabulary import (
    Programme,
    between,
    scalars,
    stated,
)

PLANAR = rr.Kinematics(rr.Robot.builtin("planar3"))


x, y, low, high, h, c = scalars("x y low high h c")


P = clip(x.sx, low.sx, high.sx)


ORDERED = stated("H1", "low <= high", high.sx - low.sx)


def make(expression, sense, variables, *hypotheses, domain=(), order=None):
    goal = Relation(expression, sense)
    return Claim("M", "mutation", "", variables, goal, hypotheses, domain, order)


def without(claim, *names):
    """A lemma that asks for less."""
    kept = tuple(h for h in claim.hypotheses if h.id not in names)
    return replace(claim, hypotheses=kept)


def decay(rows, rate, *, discrete=False):
    matrix = tuple(tuple(Fraction(entry) for entry in row) for row in rows)
    return DecayClaim("M", "mutation", "", (matrix,), Fraction(rate), discrete)


def modes(sign, weight):
    """Sum and product of the modes of (6), J = 1; a sign at (6b)."""
    p = Programme.of(1, 1)
    state = ca.vertcat(p.u.sx, p.lam.sx)
    law = ca.vertcat(-p.gradient(p.u.sx, p.lam.sx), sign * p.rows(p.u.sx))
    slope = ca.substitute(ca.jacobian(law, state), p.w.sx, weight)
    decays = -(slope[0, 0] + slope[1, 1])
    product = slope[0, 0] * slope[1, 1] - slope[0, 1] * slope[1, 0]
    return make(
        ca.vertcat(decays, product),
        ">0",
        (p.J,),
        stated("H1", "J is not 0", p.J.sx**2, ">0"),
    )


def greedy_energy():
    """The network settles at twice the rate that its energy has."""
    frozen = Frozen.of(1, 1)
    proof = decrease(frozen, "M")
    bend = frozen.drift.T @ frozen.p.weight @ frozen.drift
    margins = frozen.margins - ca.vertcat(bend, 0)
    return Proof(
        frozen.claim("M", "", margins), proof.lemmas, proof.terms, (), proof.example
    )


def rank_of_any():
    J, s = Symbol.matrix("J", (2, 3)), Symbol.vector("s", 2)
    still = stated("H1", "J's = 0", J.sx.T @ s.sx, "==0")
    return make(s.sx, "==0", (J, s), still)


def arm_is_regular():
    q = Symbol("q", PLANAR.q)
    J = PLANAR.jacobian()[:2, :]
    gram = J @ J.T
    det = gram[0, 0] * gram[1, 1] - gram[0, 1] * gram[1, 0]
    return make(det, ">0", (q,), domain=(between(q, -1, 1),))


def wrong_transpose():
    q, u = Symbol("q", PLANAR.q), Symbol.vector("u", 3)
    J = PLANAR.jacobian()
    rate = ca.jtimes(PLANAR.position(), q.sx, u.sx)
    return make(rate - J.T @ u.sx, "==0", (q, u))


def midpoints():
    p, a, b = Programme.of(2, 1), Symbol.vector("a", 2), Symbol.vector("b", 2)
    middle = (p.cost(a.sx) + p.cost(b.sx)) / 2 - p.cost((a.sx + b.sx) / 2)
    return make(middle, ">=0", (p.w, p.c, a, b))


def false_lemma():
    """A sum of instances of what is false."""
    wrong = make(x.sx, ">=0", (x, y))
    goal = make(x.sx + y.sx, ">=0", (x, y))
    uses = (Instance(0, {"x": x.sx, "y": y.sx}), Instance(0, {"x": y.sx, "y": x.sx}))
    return Proof(goal, (wrong,), (uses,))


def negative_factor():
    given = stated("H1", "x >= 0", x.sx)
    return Proof(make(-x.sx, ">=0", (x,), given), (), ((Given(0, factor=ca.SX(-1)),),))


def factor_of_unknown_sign():
    given = stated("H1", "x >= 0", x.sx)
    return Proof(
        make(x.sx * y.sx, ">=0", (x, y), given), (), ((Given(0, factor=y.sx),),)
    )


def lemma_out_of_its_domain():
    goal = make(x.sx * (x.sx - y.sx), ">=0", (x, y))
    at = {"x": x.sx, "s": x.sx, "y": y.sx, "low": low.sx, "high": high.sx}
    return Proof(
        replace(goal, variables=(x, y, low, high)),
        (lemmas.projection(),),
        ((Instance(0, at),),),
    )


def another_claims_proof():
    return Proof(make(x.sx, ">=0", (x,)), (make(x.sx**2, ">=0", (x,)),))


def mutation_of(name):
    found = case(name, PLANAR).mutation
    assert not found.holds
    return found.proof


def printed(name):
    return case(name, PLANAR).proof


GAP = P - clip(y.sx, low.sx, high.sx)


MUTATIONS = {
    "0 outside the box": lambda: make(x.sx * P, ">=0", (x, low, high), ORDERED),
    "0 on the edge of the box": lambda: make(
        x.sx * P,
        ">0",
        (x, low, high),
        stated("H1", "0 in the box", ca.vertcat(-low.sx, high.sx)),
        stated("H2", "x is not 0", x.sx**2, ">0"),
    ),
    "W = 0": lambda: modes(1, 0.0),
    "W negative": lambda: modes(1, -1.0),
    "unsquared (20)": lambda: printed("C19"),
    "(20) squared, but halved": lambda: make(
        (y.sx - x.sx) ** 2 / 2 - (P - x.sx) ** 2,
        ">=0",
        (x, y, low, high),
        stated("H1", "y in the box", ca.vertcat(y.sx - low.sx, high.sx - y.sx)),
    ),
    "sign-flipped dual": lambda: modes(-1, 0.5),
    "Euler with h c = 5/4": lambda: mutation_of("C23p"),
    "Euler with h = 2.5 epsilon": lambda: mutation_of("C24"),
    "Euler of the network, any step": lambda: mutation_of("C10"),
    "Euler of the memory cell, h = 1": lambda: make(
        1 - (x.sx + (-0.9 * x.sx + (1 - x.sx) * (1 + 0.95 * x.sx))),
        ">=0",
        (x,),
        domain=(between(x, 0, 1),),
        order="discrete",
    ),
    "singular Jacobian": rank_of_any,
    "an arm that is regular everywhere": arm_is_regular,
    "obstacle sign set of C26": lambda: printed("C26"),
    "escape with a component backwards": lambda: mutation_of("C25"),
    "V along the second-order law": lambda: printed("C17"),
    "a column of J dropped": lambda: mutation_of("C18"),
    "J transposed": wrong_transpose,
    "first integral with a plus": lambda: mutation_of("C14"),
    "a moving target without lag": lambda: mutation_of("C16"),
    "rest only where e = 0": lambda: printed("C20b"),
    "global convergence": lambda: printed("C21"),
    "q outside its limits": lambda: mutation_of("C22"),
    "4 epsilon c of any size": lambda: mutation_of("C23"),
    "pain decays": lambda: printed("C30"),
    "inputs up to 2": lambda: mutation_of("C31"),
    "no miss in finite time": lambda: printed("C34"),
    "total off by 0.01": lambda: mutation_of("C39"),
    "every quadratic cost is convex": midpoints,
    "projection against any y": lambda: without(lemmas.projection(), "y"),
    "slack without room": lambda: without(lemmas.slack(), "x"),
    "slack of more than the whole": lambda: without(lemmas.slack(), "k"),
    "limits hold 0 everywhere": lambda: without(lemmas.limits_hold_zero(), "q"),
    "complementary with t < 0": lambda: without(lemmas.complementary(), "t"),
    "nonexpansive by half": lambda: make(
        (x.sx - y.sx) * GAP - 2 * GAP**2, ">=0", (x, y, low, high), ORDERED
    ),
    "the projection expands": lambda: make(
        GAP**2 - (x.sx - y.sx) ** 2, ">=0", (x, y, low, high), ORDERED
    ),
    "energy at twice its rate": greedy_energy,
    "a false lemma": false_lemma,
    "a negative factor": negative_factor,
    "a factor of unknown sign": factor_of_unknown_sign,
    "a lemma out of its domain": lemma_out_of_its_domain,
    "the proof of another claim": another_claims_proof,
    "a square that is not one": lambda: Proof(
        make(-(x.sx**2), ">=0", (x,)), (), ((Square(x.sx),),)
    ),
    "decay without damping": lambda: decay(((0, 1), (-1, 0)), "1/10"),
    "decay faster than its modes": lambda: decay(((-1, 1), (-1, 0)), "51/100"),
    "growth in steps": lambda: decay(((1, "1/10"), ("-1/10", 1)), "1", discrete=True),
    "sine below 0.9999": lambda: make(
        0.9999 - ca.sin(x.sx), ">=0", (x,), domain=(between(x, 0, 2),)
    ),
    "contradictory hypotheses": lambda: make(
        x.sx - 5,
        "==0",
        (x,),
        stated("H1", "x >= 1", x.sx - 1),
        stated("H2", "x <= 0", -x.sx),
    ),
    "0.1 + 0.2 = 0.3 in doubles": lambda: make(
        0.1 * x.sx + 0.2 * x.sx - 0.3 * x.sx, "==0", (x,)
    ),
    "positive on an unbounded domain": lambda: make(
        1 / (1 + x.sx**2) - 1 / 1024, ">0", (x,)
    ),
    "nothing but words": lambda: replace(
        make(x.sx, ">=0", (x,)), hypotheses=(Hypothesis("A1", "x is what we like"),)
    ),
}
