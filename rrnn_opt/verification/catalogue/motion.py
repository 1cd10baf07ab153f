"""Claims that come with a formulation and its network, for any robot."""

from __future__ import annotations

from fractions import Fraction

import casadi as ca

from rrnn_opt.claim import Claim, Hypothesis, Range, Relation
from rrnn_opt.formulations.limits import velocity_bounds
from rrnn_opt.robot import Kinematics, Limits
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification.composite import Instance, Proof
from rrnn_opt.verification.lemmas import clip, limits_hold_zero, projection

GAINS = {"c1": 0.5, "c2": 0.5}
"""Of (10), 1/s; those of the paper."""
LASALLE = (
    "LaSalle in q: the box of limits is compact, so q' tends to 0 and q to the "
    "postures with J'e in the normal cone of Omega(q) at 0"
)


def reduced_law_decreases(
    kin: Kinematics, *, name: str = "reduced_law_decreases", inside: bool = True
) -> Proof:
    """V' <= -epsilon |q'|^2 along (18) with the box (10), V = |e|^2/2.

        q' = P_Omega(q)(J'e/epsilon)

    V' is the derivative of V through the forward kinematics of the robot, along
    the very law; the target stands still.

    Args:
        kin: kinematics of the robot.
        name: id of the claim.
        inside: whether q is assumed to lie within its limits.
    """
    limits, n = kin.robot.limits, kin.robot.nv
    q = Symbol("q", kin.q, "rad or m", "joint positions")
    s = Symbol.vector("s", 3, "m/s", "e/epsilon")
    epsilon = Symbol.scalar("epsilon", "s")
    low, high = velocity_bounds(q.sx, limits, **GAINS)
    x = kin.jacobian().T @ s.sx
    moved = clip(x, low, high)
    # d/dt |rd - r(q)|^2/2 = -e'r', by automatic differentiation, e = epsilon s
    rate = -epsilon.sx * ca.dot(s.sx, ca.jtimes(kin.position(), q.sx, moved))
    margin = -rate - epsilon.sx * ca.dot(moved, moved)
    stands = Hypothesis("A1", "the target stands still", added=True)
    within = Hypothesis("A2", "q(0) lies within the joint limits", added=True)
    claim = Claim(
        id=name,
        source="eq. (10), (18)-(21)",
        statement="V' <= -epsilon |q'|^2 along q' = P(J'e/epsilon), Omega(q) of (10)",
        variables=(q, s, epsilon),
        goal=Relation(margin, ">=0"),
        hypotheses=(stands, within) if inside else (stands,),
        domain=(_positive(epsilon), *([_limits(q, limits)] if inside else [])),
        order="first-order",
        jacobian="moving",
    )
    terms = tuple(_joint(i, x[i], q.sx[i], limits, epsilon.sx) for i in range(n))
    return Proof(claim, (limits_hold_zero(), projection()), (terms,), (LASALLE,))


def _joint(i: int, x: ca.SX, q: ca.SX, limits: Limits, factor: ca.SX) -> Instance:
    """(x - s) s >= 0 for one joint; without position limits the box is constant."""
    speed = float(limits.velocity[i])
    lowest, highest = float(limits.lower[i]), float(limits.upper[i])
    if abs(lowest) == float("inf") and abs(highest) == float("inf"):
        low, high = ca.SX(-speed), ca.SX(speed)
        at = {"x": x, "s": clip(x, low, high), "y": ca.SX(0), "low": low, "high": high}
        return Instance(1, at, factor=factor)
    at = {
        "x": x,
        "q": q,
        "lowest": ca.SX(lowest),
        "highest": ca.SX(highest),
        "slowest": ca.SX(-speed),
        "fastest": ca.SX(speed),
        **{c: ca.SX(value) for c, value in GAINS.items()},
    }
    return Instance(0, at, factor=factor)


def _positive(symbol: Symbol) -> Range:
    return Range(symbol.name, (Fraction(0),) * symbol.size, (None,) * symbol.size)


def _limits(q: Symbol, limits: Limits) -> Range:
    def exact(bounds: list[float]) -> tuple[Fraction | None, ...]:
        return tuple(Fraction(x) if abs(x) < float("inf") else None for x in bounds)

    return Range(q.name, exact(limits.lower.tolist()), exact(limits.upper.tolist()))
