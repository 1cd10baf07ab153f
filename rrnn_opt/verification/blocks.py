"""Claims that larger statements are built from: inward faces, curvature, rate."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import casadi as ca

from rrnn_opt.claim import Claim, Range, Relation
from rrnn_opt.errors import RrnnError, ShapeError
from rrnn_opt.symbolic.symbol import Symbol

Sides = Sequence[tuple[Fraction, Fraction]]


def inward_claims(
    name: str, source: str, state: Symbol, field: ca.SX, box: Sides
) -> tuple[Claim, ...]:
    """On every face of a box the field does not point out of it.

    A box is forward invariant under x' = f(x), f locally Lipschitz, if on each
    face x_i = b_i the component f_i is <= 0 (upper face) or >= 0 (lower face):
    Nagumo's theorem (F. Blanchini, S. Miani, "Set-Theoretic Methods in
    Control", 2nd ed., 2015, section 4.2).  Each claim is one face; its domain
    has x_i at one number.

    Args:
        name: start of the claims' ids; "-lower1", "-upper1", .. is added.
        source: where the statement is made.
        state: x, (n, 1).
        field: f(x), SX (n, 1), of the state alone.
        box: (lower, upper) of every element, n of them.

    Returns:
        2 n claims, a lower and an upper face for each element.

    Raises:
        ShapeError: field or box do not fit the state.
        RrnnError: the field depends on something else.
    """
    if field.shape != state.shape:
        raise ShapeError("field", state.shape, field.shape)
    if len(box) != state.size:
        raise ShapeError("box", (state.size,), (len(box),))
    claims = []
    for i in range(state.size):
        for side, sense, word in ((0, ">=0", "lower"), (1, "<=0", "upper")):
            low, high = ([Fraction(ends[k]) for ends in box] for k in (0, 1))
            low[i] = high[i] = Fraction(box[i][side])
            claims.append(
                Claim(
                    f"{name}-{word}{i + 1}",
                    source,
                    f"the field points into the box on the {word} face of"
                    f" {state.name}_{i + 1}",
                    (state,),
                    Relation(field[i], sense),
                    domain=(Range(state.name, tuple(low), tuple(high)),),
                    order="first-order",
                )
            )
    return tuple(claims)


def curvature_claim(
    name: str,
    source: str,
    q: Symbol,
    position: ca.SX,
    error: Symbol,
    bound: Fraction,
    domain: tuple[Range, ...],
) -> Claim:
    """``L`` is no less than the norm of the Hessian of |e|^2 / 2.

    The Hessian by q of |r_d - f(q)|^2 / 2 is H = J'J - sum_k e_k d2f_k/dq2; its
    norm is at most its largest row sum of absolute values (Gershgorin).  With
    such an L the Euler step h <= 2 epsilon / L of (18) keeps |e| from growing.

    Args:
        name: id of the claim.
        source: where the statement is made.
        q: joints, (n, 1).
        position: f(q), SX (k, 1).
        error: e, (k, 1), a variable of its own.
        bound: L.
        domain: ranges of q and e.

    Raises:
        ShapeError: the error is not of the position's shape.
    """
    if error.shape != position.shape:
        raise ShapeError("error", position.shape, error.shape)
    jacobian = ca.jacobian(position, q.sx)
    bend = ca.jacobian(ca.jacobian(ca.dot(error.sx, position), q.sx), q.sx)
    rows = ca.sum2(ca.fabs(jacobian.T @ jacobian - bend))
    return Claim(
        name,
        source,
        f"every row of |J'J - e . f''| sums to at most {bound}",
        (q, error),
        Relation(float(bound) - rows, ">=0"),
        domain=domain,
        order="discrete",
        jacobian="moving",
    )


def rate_claim(
    name: str,
    source: str,
    q: Symbol,
    jacobian: ca.SX,
    polar: Symbol,
    *,
    epsilon: float,
    delta: float,
    alpha: float,
    domain: tuple[Range, ...],
) -> Claim:
    """V' <= -alpha V along (18) for a planar task, saturation included.

    With e = r (cos t, sin t) and y = J'(cos t, sin t), V = r^2 / 2 and
    V' = -r y'P(r y / epsilon), P the projection on [-delta, delta].  Divided by
    -r < 0 the statement is y'P(r y / epsilon) - alpha r / 2 >= 0, which spares
    intervals the factor r^2.

    Args:
        name: id of the claim.
        source: where the statement is made.
        q: the joints that J depends on, (k, 1).
        jacobian: J, SX (2, n).
        polar: (t, r), rad and m, (2, 1).
        epsilon: of (18).
        delta: the velocity bounds are at least this far from 0.
        alpha: the rate, 1/s.
        domain: ranges of q and of (t, r), r > 0.

    Raises:
        ShapeError: the task is not planar.
        RrnnError: r may be 0.
    """
    if jacobian.shape[0] != 2:
        raise ShapeError("jacobian", (2, jacobian.shape[1]), jacobian.shape)
    least = [r.lower[1] for r in domain if r.variable == polar.name]
    if not any(low is not None and low > 0 for low in least):
        raise RrnnError(f"{name}: the length of the error must be positive")
    t, r = polar.sx[0], polar.sx[1]
    y = jacobian.T @ ca.vertcat(ca.cos(t), ca.sin(t))
    velocity = ca.fmin(ca.fmax(r * y / epsilon, -delta), delta)
    return Claim(
        name,
        source,
        f"V' <= -{alpha:g} V, bounds {delta:g} from 0, epsilon = {epsilon:g}",
        (q, polar),
        Relation(ca.dot(y, velocity) - alpha * r / 2, ">=0"),
        domain=domain,
        order="first-order",
        jacobian="moving",
    )
