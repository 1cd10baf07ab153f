"""Hildreth's sweep: the dual network, one neuron at a time."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.dynamics import DiscreteDynamics
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks.dual_parts import DualParts, DualProjection
from rrnn_opt.networks.projection import ProjectionMap
from rrnn_opt.symbolic.sets import Box

SILENT = 1e-12
"""A row a with a M a' below this is left out, as in the C text."""


@checked()
@dataclass(frozen=True)
class Hildreth(DualProjection[DiscreteDynamics], ProjectionMap):
    """One sweep over the neurons of ``DualNetwork``, each solved in its turn.

    Row i in order, equality rows, inequality rows, then the bounds:

        lambda_i+ = lambda_i + (b_i - a_i x) / (a_i M a_i')
        mu_i+     = max(mu_i + (g_i x - h_i) / (g_i M g_i'), 0)
        z_i+      = (v - P_i(v)) / M_ii,   v = x_i + M_ii z_i

    P_i being the projection on [lb_i, ub_i], x = M (A' lambda - G' mu - z - q) being
    carried along.  This is coordinate
    ascent of the dual; it converges wherever the programme is feasible, fast
    where rows are nearly orthogonal.  For P = I and inequality rows it is the
    sweep of emit/support/hildreth.h, which the planner runs, operation by
    operation but for x, which is made from the multipliers at its start.

    Attributes:
        whiten, delta: see ``ProjectionNetwork``.

    Raises:
        RrnnError: delta is not positive and finite.

    Source:
        C. Hildreth, "A quadratic programming procedure", Naval Research
        Logistics Quarterly 4, 1957.  Equality rows and bounds are ours.
    """

    extra = frozenset({"sq", "div", "lt", "not", "if_else_zero"})

    def _made(self, form: Formulation) -> DiscreteDynamics:
        parts = DualParts.of(form, "Hildreth")
        return DiscreteDynamics(
            name=f"hildreth_{form.name}", next=_sweep(parts), **parts.common()
        )


def _sweep(parts: DualParts) -> ca.SX:
    """The multipliers after every neuron had its turn."""
    qp, M, x = parts.form.qp, parts.inverse, parts.primal
    following: list[ca.SX] = []
    for symbol in parts.symbols:
        for i, old in enumerate(ca.vertsplit(symbol.sx)):
            if symbol.name == "lam":
                value, pull = _row(old, qp.A[i, :], qp.b[i], x, M)
            elif symbol.name == "mu":
                value, pull = _row(old, -qp.G[i, :], -qp.h[i], x, M, above=True)
            else:
                around = Box(qp.lb[i], qp.ub[i])
                value, pull = _bound(old, around, x[i], M[:, i], i)
            x = ca.densify(x + pull * (value - old))
            following.append(value)
    return ca.vertcat(*following)


def _row(
    old: ca.SX, row: ca.SX, want: ca.SX, x: ca.SX, M: ca.SX, *, above: bool = False
) -> tuple[ca.SX, ca.SX]:
    """The multiplier that makes ``row x = want`` (or ``>=``), and dx by it."""
    pull = M @ row.T
    norm2 = ca.dot(row.T, pull)
    wanted = old + (want - ca.dot(row.T, x)) / norm2
    value = ca.fmax(wanted, 0) if above else wanted
    return ca.if_else(norm2 > SILENT, value, old), pull


def _bound(
    old: ca.SX, interval: Box, x: ca.SX, column: ca.SX, i: int
) -> tuple[ca.SX, ca.SX]:
    """The multiplier that keeps x_i in its interval, and dx by it."""
    weight = column[i]
    free = x + weight * old
    return (free - interval.project(free)) / weight, -column
