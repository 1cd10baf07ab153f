"""C24: V does not increase along (18) in Euler steps."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import (
    ClaimCase,
    Given,
    Instance,
    Mutation,
    Proof,
    Repair,
)
from rrnn_opt.verification.blocks import curvature_claim
from rrnn_opt.verification.composite import Term
from rrnn_opt.verification.lemmas import clip, projection
from rrnn_opt.verification.vocabulary import added, between, not_negative, scalars

JOINTS = 7


def case(kinematics: Kinematics) -> ClaimCase:
    """V(q + h p) <= V(q) for p = P(x), x = J'e/epsilon, h <= 2 epsilon/L; 7 joints.

    L bounds the Hessian of V on the step, so that V+ <= V - h epsilon x'p +
    L h^2 |p|^2/2 (the lemma of descent).  Then

        V - V+ >= h epsilon sum (x_i - p_i) p_i + (h/2)(2 epsilon - L h) |p|^2.

    The mutation is h = 2.5 epsilon for one joint with f(q) = q, where L = 1; the
    repaired statement is an L for one arm.

    Args:
        kinematics: not used; the statement is about any arm.
    """
    x = Symbol.vector("x", JOINTS, "rad/s", "J'e/epsilon")
    low, high = Symbol.vector("low", JOINTS), Symbol.vector("high", JOINTS)
    now, then, h, L, epsilon = scalars("V V_next h L epsilon")
    p = clip(x.sx, low.sx, high.sx)
    size = ca.dot(p, p)
    bound = now.sx - h.sx * epsilon.sx * ca.dot(x.sx, p) + L.sx * h.sx**2 / 2 * size
    claim = Claim(
        id="C24",
        source="eq. (18)",
        statement="V does not increase in an Euler step of (18)",
        variables=(x, low, high, now, then, h, L, epsilon),
        goal=Relation(now.sx - then.sx, ">=0"),
        hypotheses=(
            added(
                "A1",
                "V_next <= V - h epsilon x'p + L h^2 |p|^2/2, which holds where L "
                "bounds the Hessian of V on the step (Taylor)",
                bound - then.sx,
            ),
            added("A2", "h <= 2 epsilon/L", 2 * epsilon.sx - L.sx * h.sx),
            added("A3", "0 lies in Omega", ca.vertcat(-low.sx, high.sx)),
        ),
        domain=not_negative(h, epsilon),
        order="discrete",
        jacobian="moving",
    )
    given = {"x": x.sx, "s": p, "low": low.sx, "high": high.sx}
    joints = _projected(given, h.sx * epsilon.sx)
    terms: tuple[Term, ...] = (Given(0), *joints, Given(1, 0, h.sx * size / 2))
    example = {s.name: [0] * s.size for s in claim.variables}
    proof = Proof(claim, (projection(),), (terms,), (), example)
    mutation = Mutation("h = 2.5 epsilon", _longer())
    return ClaimCase(proof, mutation, (), Repair(_curvature()))


def _projected(given: dict[str, ca.SX], factor: ca.SX) -> tuple[Instance, ...]:
    """The lemma on projections with y = 0, once a joint."""
    zero = ca.SX(0)
    return tuple(
        Instance(0, {k: v[i] for k, v in given.items()} | {"y": zero}, factor=factor)
        for i in range(JOINTS)
    )


def _curvature() -> Claim:
    """L = 9 for a planar arm of two links of 1 m and errors of 1/2 m an axis."""
    q, error = Symbol.vector("q", 2, "rad"), Symbol.vector("e", 2, "m")
    angle = q.sx[0] + q.sx[1]
    tip = ca.vertcat(ca.cos(q.sx[0]) + ca.cos(angle), ca.sin(q.sx[0]) + ca.sin(angle))
    ranges = (between(q, -4, 4), between(error, "-1/2", "1/2"))
    claim = curvature_claim("C24", "eq. (18)", q, tip, error, Fraction(9), ranges)
    statement = "L = 9 bounds the Hessian of V for two links of 1 m at every posture"
    return replace(claim, statement=f"{statement}, |e_k| <= 1/2 m")


def _longer() -> Claim:
    """One joint, f(q) = q, epsilon = 1: e+ = e - h e."""
    (e,) = scalars("e")
    moved = e.sx - 2.5 * e.sx
    goal = Relation(e.sx**2 / 2 - moved**2 / 2, ">=0")
    return Claim("C24", "eq. (18)", "V falls for h = 2.5 epsilon", (e,), goal)
