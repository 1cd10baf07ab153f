"""What networks in the variables (u, lambda, mu) of the Lagrangian share."""

from __future__ import annotations

from typing import Any

import casadi as ca

from rrnn_opt.formulation import Formulation
from rrnn_opt.symbolic.lagrangian import Lagrangian
from rrnn_opt.symbolic.sets import Box
from rrnn_opt.symbolic.symbol import Symbol


def lagrangian_parts(form: Formulation) -> dict[str, Any]:
    """All of the dynamics but name and law, for a network in (u, lambda, mu).

    The state is the decision with the Lagrangian's multipliers, the output the
    decision, the residual that of the KKT conditions; a run starts with zero
    multipliers at the u in Omega nearest to zero.
    """
    law, qp = form.lagrangian, form.qp
    multipliers = {s.name: s.sx for s in law.symbols[1:]}
    if qp.bounded:
        multipliers["z_box"] = law.bound_dual
    nearest = Box(qp.lb, qp.ub).project(ca.SX.zeros(form.decision.size, 1))
    silent = [ca.SX.zeros(*s.shape) for s in law.symbols[1:]]
    return {
        "state": stacked(law.symbols),
        "parameters": form.parameters,
        "output": form.decision.sx,
        "residual": law.residual,
        "multipliers": multipliers,
        "formulation": form,
        "start": ca.vertcat(nearest, *silent),
    }


def stacked(symbols: tuple[Symbol, ...]) -> Symbol:
    """The one symbol, or all of them stacked as one."""
    if len(symbols) == 1:
        return symbols[0]
    column = ca.vertcat(*(s.sx for s in symbols))
    units = ", ".join(s.unit for s in symbols)
    meaning = "stacked " + ", ".join(s.name for s in symbols)
    return Symbol("state", column, units, meaning)


def transposed(law: Lagrangian, column: ca.SX) -> ca.SX:
    """``H' column`` for the monotone map ``F(z) = H z + p``.

        H = [[P, -A', G'], [A, 0, 0], [-G, 0, 0]]

    Args:
        law: of the formulation.
        column: as long as z = (u, lambda, mu).
    """
    qp = law.qp
    n, p = qp.decision.size, qp.A.size1()
    first, second, third = ca.vertsplit(column, [0, n, n + p, column.size1()])
    top = ca.sparsify(qp.P).T @ first
    parts = []
    if law.equality_dual is not None:
        top = top + qp.A.T @ second
        parts.append(-qp.A @ first)
    if law.inequality_dual is not None:
        top = top - qp.G.T @ third
        parts.append(qp.G @ first)
    return ca.densify(ca.vertcat(top, *parts))
