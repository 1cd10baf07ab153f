"""The joint limits, the first-order law, obstacle rows and the memory cell."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import isfinite

import casadi as ca

from rrnn_opt.claim import Claim, Hypothesis, Range, Relation
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.limits import velocity_bounds
from rrnn_opt.networks import MemoryCell
from rrnn_opt.robot import Kinematics, Limits
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification.composite import Given, Instance, Proof
from rrnn_opt.verification.lemmas import (
    clip,
    limits_hold_zero,
    nonexpansive,
    projection,
)

GAINS = {"c1": 0.5, "c2": 0.5}
"""Of (10), 1/s; those of the paper."""
NAGUMO = "Nagumo: a set that a Lipschitz field does not leave at its edge is kept"
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


def limits_are_kept(form: Formulation, kin: Kinematics) -> Proof | None:
    """The bounds of a scheme hold 0, and at a limit they do not lead out of it.

        lower <= 0 <= upper                 for q within its limits
        lower_i >= 0  at q_i = q-_i,        upper_i <= 0  at q_i = q+_i

    which is Nagumo's condition for every q' within the bounds.

    Args:
        form: a scheme in joint velocities whose parameters hold q.
        kin: kinematics of the robot.

    Returns:
        The proof; None for a scheme without such bounds.
    """
    limits, n = kin.robot.limits, kin.robot.nv
    q = next((p for p in form.parameters if p.name == "q"), None)
    if q is None or form.level != "velocity" or not ca.depends_on(form.lower, q.sx):
        return None
    low, high = form.lower[:n], form.upper[:n]
    rows = [-low, high]
    for i in range(n):
        ends = ((low[i], float(limits.lower[i])), (-high[i], float(limits.upper[i])))
        rows += [ca.substitute(x, q.sx[i], at) for x, at in ends if isfinite(at)]
    others = [
        p
        for p in form.parameters
        if p is not q and ca.depends_on(ca.vertcat(*rows), p.sx)
    ]
    claim = Claim(
        id="limits_are_kept",
        source="eq. (10)",
        statement=f"the bounds of {form.name} hold 0 and keep the joint limits",
        variables=(q, *others),
        goal=Relation(ca.vertcat(*rows), ">=0"),
        domain=(_limits(q, limits),),
        order="first-order",
    )
    return Proof(claim, (claim,), (), (f"{NAGUMO}; q(0) lies within the limits",))


def clearance_is_kept(
    form: Formulation, kin: Kinematics, contacts: Sequence[int]
) -> Proof | None:
    """The rows of ``clearance_rows`` bound how fast a clearance shrinks.

        n'd/dt centre(q) + gamma (d - d_safe) >= 0

    with the velocity of the sphere's centre differentiated automatically, gamma
    and d_safe being those of the rows.

    Args:
        form: made by ``clearance_rows``.
        kin: kinematics of the robot.
        contacts: index of the sphere in each contact.
    """
    if form.name != "clearance_rows" or not contacts:
        return None
    known = {p.name: p for p in form.parameters}
    q, n, d = known["q"], known["normals"], known["clearances"]
    centres = kin.sphere_centres()
    rates = [
        ca.dot(n.sx[:, k], ca.jtimes(centres[:, c], q.sx, form.decision.sx))
        for k, c in enumerate(contacts)
    ]
    # a row is least - n'J u <= 0, with least = -gamma (d - d_safe)
    still = ca.SX.zeros(*form.decision.shape)
    least = ca.substitute(form.inequalities, form.decision.sx, still)
    gamma, safe = _line(least[0], d.sx[0])
    claim = Claim(
        id="clearance_is_kept",
        source="eq. (11)-(12), repaired",
        statement=f"d' >= -{gamma:g} (d - {safe:g}) for every contact",
        variables=(form.decision, q, n, d),
        goal=Relation(ca.vertcat(*rates) - least, ">=0"),
        hypotheses=(
            Hypothesis("H1", "the rows hold", Relation(form.inequalities, "<=0")),
            Hypothesis("A1", "obstacles stand still, normals are theirs", added=True),
        ),
        order="first-order",
        jacobian="moving",
    )
    terms = tuple((Given(0, k),) for k in range(len(contacts)))
    return Proof(claim, (), terms, (NAGUMO,))


def _line(least: ca.SX, d: ca.SX) -> tuple[float, float]:
    """Gamma and d_safe of ``least = -gamma (d - d_safe)``, for the reader."""
    slope = -float(ca.jacobian(least, d))
    return slope, float(ca.substitute(least, d, 0)) / slope


def memory_stays_bounded(cell: MemoryCell | None = None) -> Proof:
    """The activity of the memory cell (14) stays in [0, 1] for inputs I >= 0.

    Args:
        cell: that of the planner by default.
    """
    cell = cell or MemoryCell()
    stimulus = Symbol.scalar("I", "1", "input")
    ends = (cell.derivative(ca.SX(x), stimulus.sx) for x in (0.0, 1.0))
    at_zero, at_one = ends
    claim = Claim(
        id="memory_stays_bounded",
        source="eq. (14)",
        statement="x' >= 0 at x = 0 and x' <= 0 at x = 1 for the planner's cell",
        variables=(stimulus,),
        goal=Relation(ca.vertcat(at_zero, -at_one), ">=0"),
        domain=(_positive(stimulus),),
        order="first-order",
    )
    return Proof(claim, (claim,), (), (NAGUMO,))


def projection_law(n: int) -> Proof:
    """|P(x) - P(y)|^2 <= (x - y)'(P(x) - P(y)) for a box of n sides.

    The projection is firmly nonexpansive, which no network would settle without.

    Args:
        n: number of joints.
    """
    x, y = Symbol.vector("x", n), Symbol.vector("y", n)
    low, high = Symbol.vector("low", n), Symbol.vector("high", n)
    px, py = (clip(z.sx, low.sx, high.sx) for z in (x, y))
    ordered = Relation(high.sx - low.sx, ">=0")
    claim = Claim(
        id="projection_law",
        source="eq. (9)",
        statement=f"the projection of {n} joints is firmly nonexpansive",
        variables=(x, y, low, high),
        goal=Relation(ca.dot(x.sx - y.sx, px - py) - ca.dot(px - py, px - py), ">=0"),
        hypotheses=(Hypothesis("H1", "the box is not empty", ordered),),
    )
    terms = tuple(
        Instance(0, {"x": x.sx[i], "y": y.sx[i], "low": low.sx[i], "high": high.sx[i]})
        for i in range(n)
    )
    example = {"x": [0] * n, "y": [0] * n, "low": [-1] * n, "high": [1] * n}
    return Proof(claim, (nonexpansive(),), (terms,), (), example)
