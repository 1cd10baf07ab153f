"""The programme that the exact fallback solves, and how its answer is used."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from rrnn_opt.dynamics import Dynamics
from rrnn_opt.emit.active_set import FIELDS, Factor
from rrnn_opt.formulation import Formulation
from rrnn_opt.symbolic import Tape, shape_of


@dataclass(frozen=True, eq=False)
class Programme:
    """``min 1/2 u'Pu + q'u`` with rows and bounds, of the parameters.

    Attributes:
        tape: parameters to q, A, b, G, h, lb, ub.
        sizes: unknowns, equality rows, inequality rows.
        factor: of the Hessian.
        restart: whether the network's state is (u, lambda, mu), and is put at
            the solution.
    """

    tape: Tape
    sizes: tuple[int, int, int]
    factor: Factor
    restart: bool


def programme(dynamics: Dynamics) -> Programme | None:
    """The programme whose solution a network's output tends to.

    The equality rows are those that the network sees, whitened ones included,
    so that its multipliers are the solution's; None for a network that was
    made from no formulation, or whose output is something else.

    Args:
        dynamics: any network.
    """
    form = dynamics.formulation
    if form is None or shape_of(dynamics.output) != form.decision.shape:
        return None
    restart = _in_multipliers(dynamics, form)
    A, b = _rows(dynamics, form) if restart else (form.qp.A, form.qp.b)
    qp = form.qp
    values = (qp.q, A, b, qp.G, qp.h, qp.lb, qp.ub)
    function = ca.Function(
        "programme",
        [s.sx for s in form.parameters],
        [ca.densify(value) for value in values],
        [s.name for s in form.parameters],
        [f"qp_{name}" for name in FIELDS],
    )
    n, p, m = form.decision.size, int(A.size1()), int(qp.G.size1())
    return Programme(Tape.of(function), (n, p, m), Factor.of(qp.hessian), restart)


def _in_multipliers(dynamics: Dynamics, form: Formulation) -> bool:
    """Whether the state is (u, lambda, mu) and the residual that of the KKT rows."""
    n, p = form.decision.size, int(form.equalities.size1())
    m = int(form.inequalities.size1())
    if dynamics.state.size != n + p + m:
        return False
    own = ca.vertsplit(dynamics.state.sx)[:n]
    if not all(
        ca.is_equal(a, b)
        for a, b in zip(own, ca.vertsplit(form.decision.sx), strict=True)
    ):
        return False
    rest = ca.vertsplit(dynamics.state.sx)[n:]
    rows = dynamics.residual[n : n + p]
    return not rest or not p or not ca.depends_on(rows, ca.vertcat(*rest))


def _rows(dynamics: Dynamics, form: Formulation) -> tuple[ca.SX, ca.SX]:
    """A and b of the residual's rows ``b - A u``."""
    n, p = form.decision.size, int(form.equalities.size1())
    slope, constant = ca.linear_coeff(dynamics.residual[n : n + p], form.decision.sx)
    return -slope, constant
