"""Decay of a network at given postures: continuous, and in Euler steps."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from rrnn_opt.claim import Hypothesis
from rrnn_opt.decay import DecayClaim
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks import Network
from rrnn_opt.robot import Kinematics

Array = NDArray[np.float64]
STEP = 0.05
"""How far a joint is moved from the bent posture, rad or m."""
BITS = 20
"""Matrices and rates are rounded to multiples of 2^-20."""
FREE = Hypothesis("A1", "no bound is active", added=True)
RESTS = Hypothesis("A2", "the optimum stands still while J moves", added=True)


def exponential_rate(form: Formulation, kin: Kinematics) -> DecayClaim | None:
    """(6) decays at a quarter of its slowest mode in the hull of some Jacobians.

    In the time unit epsilon, with no bound active and an optimum that stands
    still, the distance z from the optimum obeys ``z' = -[[P, -A'], [A, 0]] z``.
    A(q) is taken at a bent posture and at one step from it along each joint in
    both directions.  The claim is about every A(t) in the hull of these
    matrices; A at a posture between them need not lie in it.

    Args:
        form: with equality rows and without inequality rows.
        kin: kinematics of the robot.

    Returns:
        The claim; None where the network has no such rows, or does not decay.
    """
    matrices = _cell(form, kin)
    if matrices is None:
        return None
    slowest = -max(float(np.max(np.linalg.eigvals(a).real)) for a in matrices)
    if slowest <= 1e-6:
        return None
    rate = Fraction(max(int(slowest / 4 * 2**BITS), 1), 2**BITS)
    return DecayClaim(
        id="exponential_rate",
        source="eq. (6)",
        statement=f"the network of {form.name} decays at {float(rate):.3g}/epsilon "
        f"for every J in the hull of those at {len(matrices)} postures, "
        f"{STEP} around a bent one",
        vertices=tuple(_exact(a) for a in matrices),
        rate=rate,
        hypotheses=(FREE, RESTS),
        order="second-order",
        jacobian="moving",
    )


def euler_step(
    form: Formulation, network: Network, kin: Kinematics
) -> DecayClaim | None:
    """Half the step that the network's ``euler_bound`` allows contracts.

    Args:
        form: with equality rows and without inequality rows.
        network: with a time constant ``epsilon``.
        kin: kinematics of the robot.

    Returns:
        The claim at the bent posture; None where no step is promised.
    """
    matrices, epsilon = _cell(form, kin), getattr(network, "epsilon", None)
    if matrices is None or epsilon is None:
        return None
    values = {p.name: np.zeros(p.shape) for p in form.parameters}
    step = network.euler_bound(form, **values | {"q": _bent(kin)})
    ratio = Fraction(int(step / epsilon / 2 * 2**BITS), 2**BITS)
    first = _exact(matrices[0])
    moved = tuple(
        tuple(int(i == j) + ratio * x for j, x in enumerate(row))
        for i, row in enumerate(first)
    )
    radius = np.max(np.abs(np.linalg.eigvals(np.array(moved, dtype=np.float64))))
    if ratio <= 0 or radius >= 1.0:
        return None
    rate = Fraction(int((1 + radius) / 2 * 2**BITS) + 1, 2**BITS)
    return DecayClaim(
        id="euler_step",
        source="eq. (6)",
        statement=f"Euler steps of {float(ratio):.3g} epsilon contract by "
        f"{float(rate):.6g} a step at a bent posture",
        vertices=(moved,),
        rate=rate,
        discrete=True,
        hypotheses=(FREE,),
        order="discrete",
        jacobian="frozen",
    )


def _cell(form: Formulation, kin: Kinematics) -> list[Array] | None:
    """-[[P, -A'], [A, 0]] at the postures, rows that never move left out."""
    rows = [k for k in range(form.qp.A.size1()) if not form.qp.A[k, :].is_zero()]
    only_q = {p.name for p in form.parameters if ca.depends_on(form.qp.A, p.sx)}
    if not rows or form.inequalities.size1() or only_q - {"q"}:
        return None
    compute = ca.Function("A", [kin.q], [form.qp.A[rows, :]])
    P = form.qp.hessian
    matrices = []
    for posture in _postures(kin):
        A = np.round(np.asarray(compute(posture)) * 2**BITS) / 2**BITS
        zero = np.zeros((len(rows), len(rows)))
        matrices.append(-np.block([[P, -A.T], [A, zero]]))
    return matrices


def _postures(kin: Kinematics) -> Sequence[Array]:
    bent = _bent(kin)
    steps = STEP * np.vstack([np.eye(len(bent)), -np.eye(len(bent))])
    return [bent, *(bent + step for step in steps)]


def _bent(kin: Kinematics) -> Array:
    """Each joint at 65 % of its range, as far as that lies within +-2 rad or m."""
    limits = kin.robot.limits
    low, high = np.maximum(limits.lower, -2.0), np.minimum(limits.upper, 2.0)
    return np.clip(low + 0.65 * (high - low), limits.lower, limits.upper)


def _exact(matrix: Array) -> tuple[tuple[Fraction, ...], ...]:
    return tuple(tuple(Fraction(float(x)) for x in row) for row in matrix)
