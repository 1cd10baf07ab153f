"""What a network's graph really holds, beside what the network declares."""

from __future__ import annotations

import casadi as ca
import numpy as np

from rrnn_opt.dynamics import DiscreteDynamics, Dynamics, NeuralDynamics
from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks.network import Network
from rrnn_opt.symbolic.symbol import Symbol
from rrnn_opt.symbolic.tape import Tape

_PLUMBING = frozenset({"input", "output", "const"})


def own_operations(rule: Network, form: Formulation) -> frozenset[str]:
    """Operations that a network adds to those of a formulation.

    The network is made from ``opaque(form)``, in whose graph the formulation
    itself has no operation but the products with the decision.

    Args:
        rule: any network.
        form: a formulation that it does not refuse.

    Returns:
        Names of tape operations of law, output and multipliers; see
        ``function_operations``.
    """
    return graph_operations(rule(opaque(form)))


def graph_operations(dynamics: Dynamics) -> frozenset[str]:
    """All operations in law, output and multipliers of a network.

    Args:
        dynamics: any.

    Raises:
        RrnnError: it is neither a flow nor a map.
    """
    parts = [_law(dynamics), dynamics.output, *dynamics.multipliers.values()]
    symbols = (dynamics.state, *dynamics.parameters)
    names = [s.name for s in symbols]
    outputs = [f"part{k}" for k in range(len(parts))]
    fn = ca.Function("graph", [s.sx for s in symbols], parts, names, outputs)
    return function_operations(fn)


def function_operations(fn: ca.Function) -> frozenset[str]:
    """Names of the tape operations of a function.

    A division by a constant number is called "scale", and "inv" (one over
    something) a "div".

    Args:
        fn: any.
    """
    tape = Tape.of(fn)
    constants = {s.out for s in tape.instructions if s.op == "const"}
    found = {
        "scale" if s.op == "div" and s.args[1] in constants else s.op
        for s in tape.instructions
    }
    named = {"div" if op == "inv" else op for op in found}
    return frozenset(named) - _PLUMBING


def opaque(form: Formulation) -> Formulation:
    """The same shapes and P, every other number of the data a parameter.

        minimise    1/2 u'Pu + q'u
        subject to  b - A u = 0,   G u - h <= 0,   lb <= u <= ub

    Args:
        form: any formulation.

    Returns:
        Formulation with parameters data_q, data_A, .. in place of its own; sides
        of the bounds that are infinite for all parameters stay so.
    """
    qp, u = form.qp, form.decision.sx
    q, A, b, G, h, lb, ub = (
        Symbol.matrix(f"data_{name}", getattr(qp, name).shape, "1", f"{name} of the QP")
        for name in ("q", "A", "b", "G", "h", "lb", "ub")
    )
    used = [q, *([A, b] if b.size else []), *([G, h] if h.size else [])]
    used += [lb, ub] if qp.bounded else []
    P = ca.SX(ca.sparsify(ca.DM(qp.hessian)))
    return Formulation(
        name=form.name,
        decision=form.decision,
        parameters=tuple(used),
        cost=ca.bilin(P, u, u) / 2 + ca.dot(q.sx, u),
        equalities=b.sx - A.sx @ u,
        inequalities=G.sx @ u - h.sx,
        lower=_side(qp.lb, lb.sx),
        upper=_side(qp.ub, ub.sx),
        citation=form.citation,
        level=form.level,
    )


def _side(declared: ca.SX, symbol: ca.SX) -> ca.SX:
    sides = zip(ca.vertsplit(declared), ca.vertsplit(symbol), strict=True)
    return ca.vertcat(*(d if _infinite(d) else s for d, s in sides))


def _infinite(value: ca.SX) -> bool:
    return bool(value.is_constant()) and bool(np.isinf(float(value)))


def _law(dynamics: Dynamics) -> ca.SX:
    if isinstance(dynamics, NeuralDynamics):
        return dynamics.derivative
    if isinstance(dynamics, DiscreteDynamics):
        return dynamics.next
    raise RrnnError(f"{dynamics.name}: neither an ODE nor a map")
