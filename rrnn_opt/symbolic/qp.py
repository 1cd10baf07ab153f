"""Standard form of a convex quadratic programme, symbolic in its parameters."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from rrnn_opt.errors import InfeasibleQpError, NotAQpError, NotFiniteError
from rrnn_opt.symbolic.definite import negative_direction
from rrnn_opt.symbolic.degree import require_degree
from rrnn_opt.symbolic.symbol import Symbol
from rrnn_opt.symbolic.values import arguments

if TYPE_CHECKING:
    import qpsolvers

Array = NDArray[np.float64]
FIELDS = ("P", "q", "A", "b", "G", "h", "lb", "ub")


@dataclass(frozen=True, eq=False)
class QP:
    """``min 1/2 u'Pu + q'u + r`` s.t. ``A u = b, G u <= h, lb <= u <= ub``.

    With equality rows declared as ``e(u) == 0``, ``A = -de/du`` and
    ``b = e(0)``, so that ``e = b - A u``: the row ``rd_dot - J u`` gives
    ``A = J, b = rd_dot``, and a multiplier of ``e`` is minus the ``y`` of
    qpsolvers whatever sign the row was written with.  Multipliers of the
    inequality rows are its ``z``.

    Attributes:
        decision: u, (n, 1).
        parameters: what the data depend on.
        P: Hessian, (n, n), constant, symmetric positive semidefinite.
        q: linear term, (n, 1), unit of the cost over that of u.
        r: constant term, (1, 1), unit of the cost.
        A: (p, n); p = 0 without equalities.
        b: (p, 1).
        G: (m, n); m = 0 without inequalities.
        h: (m, 1).
        lb: (n, 1), -inf where there is no bound.
        ub: (n, 1), +inf where there is no bound.
    """

    decision: Symbol
    parameters: tuple[Symbol, ...]
    P: ca.SX
    q: ca.SX
    r: ca.SX
    A: ca.SX
    b: ca.SX
    G: ca.SX
    h: ca.SX
    lb: ca.SX
    ub: ca.SX

    @staticmethod
    def of(
        decision: Symbol,
        parameters: tuple[Symbol, ...],
        *,
        cost: ca.SX,
        equalities: ca.SX,
        inequalities: ca.SX,
        lower: ca.SX,
        upper: ca.SX,
    ) -> QP:
        """Take a declaration apart, after the degree walk.

        Args:
            decision: u, (n, 1).
            parameters: all other free symbols.
            cost: (1, 1), quadratic in u.
            equalities: e, (p, 1), affine in u; ``e == 0`` is meant.
            inequalities: g, (m, 1), affine in u; ``g <= 0`` is meant.
            lower: (n, 1), free of u.
            upper: (n, 1), free of u.

        Raises:
            NotAQpError: some part is not what it must be, the Hessian depends
                on a parameter, or it is not positive semidefinite.
            NotFiniteError: the Hessian holds NaN or an infinite number.
        """
        parts = (
            ("cost", cost, 2),
            ("equality", equalities, 1),
            ("inequality", inequalities, 1),
            ("lower bound", lower, 0),
            ("upper bound", upper, 0),
        )
        for where, expr, most in parts:
            require_degree(expr, decision, parameters, most=most, where=where)
        u = decision.sx
        hessian, q, r = ca.quadratic_coeff(cost, u)
        A, b = ca.linear_coeff(equalities, u)
        G, h = ca.linear_coeff(inequalities, u)
        P = ca.SX(_convex(hessian))
        data = (P, q, r, -A, b, G, -h, lower, upper)
        return QP(decision, parameters, *(ca.densify(x) for x in data))

    @property
    def hessian(self) -> Array:
        """P as numbers, (n, n)."""
        return np.asarray(ca.DM(self.P))

    @cached_property
    def bounded(self) -> bool:
        """Whether some element of u has a bound."""
        sides = (self.lb, -np.inf), (self.ub, np.inf)
        return any(
            not (x.is_constant() and float(x) == free)
            for side, free in sides
            for x in ca.vertsplit(side)
        )

    def functions(self) -> dict[str, ca.Function]:
        """``{"qp": f}`` with f from the parameters to qp_P, qp_q, .., qp_ub.

        The prefix keeps them apart from parameters; joint positions are ``q``.
        """
        return {"qp": self._function}

    @cached_property
    def _function(self) -> ca.Function:
        inputs = [s.sx for s in self.parameters]
        outputs = [getattr(self, field) for field in FIELDS]
        names = [s.name for s in self.parameters]
        return ca.Function("qp", inputs, outputs, names, [f"qp_{f}" for f in FIELDS])

    def at(self, **parameters: ArrayLike) -> qpsolvers.Problem:
        """The programme for given parameters.

        Args:
            **parameters: one array a parameter, of exactly its shape.

        Returns:
            The record that every solver back end reads; absent parts are None.

        Raises:
            RrnnError: a parameter is missing or unknown.
            ShapeError: a value has the wrong shape.
            NotFiniteError: a value, or a coefficient that follows from it, is
                NaN or infinite.
            NotAQpError: P is not positive semidefinite, in a QP made by hand.
            InfeasibleQpError: no number lies between two bounds.
        """
        import qpsolvers

        values = arguments(self.parameters, parameters, "qp.at")
        out = self._function.call([ca.DM(v) for v in values])
        data = {k: np.asarray(v) for k, v in zip(FIELDS, out, strict=True)}
        for name in ("q", "b", "h", "lb", "ub"):
            data[name] = data[name].ravel()
        _check(data)
        some = {k: v if v.size else None for k, v in data.items()}
        if not self.bounded:
            some |= {"lb": None, "ub": None}
        return qpsolvers.Problem(**some)


def _convex(hessian: ca.SX) -> Array:
    """The Hessian as numbers, when it is constant and positive semidefinite."""
    dense = ca.densify(hessian)
    for j in range(dense.size2()):
        for i in range(dense.size1()):
            if not dense[i, j].is_constant():
                raise NotAQpError(
                    "cost",
                    "parameter-dependent Hessian",
                    "make its quadratic part constant; convexity would have to "
                    "be proved for all parameters",
                    expression=f"P[{i},{j}] = {dense[i, j]}"[:120],
                )
    P = np.asarray(ca.DM(dense))
    if not np.all(np.isfinite(P)):
        raise NotFiniteError("cost: Hessian")
    P = np.tril(P) + np.tril(P, -1).T
    direction = negative_direction(P)
    if direction is not None:
        v = ", ".join(f"{float(x):g}" for x in direction)
        advice = f"v'Pv is negative for v = [{v}]; make P positive semidefinite"
        raise NotAQpError("cost", "indefinite Hessian", advice)
    return P


def _check(data: dict[str, Array]) -> None:
    for name in ("P", "q", "A", "b", "G", "h"):
        if not np.all(np.isfinite(data[name])):
            raise NotFiniteError(f"qp.at: {name}")
    lowest = np.linalg.eigvalsh(data["P"])[0]
    if lowest < -1e-10 * max(1.0, np.abs(data["P"]).max()):
        raise NotAQpError("qp.at", "indefinite Hessian", f"eigenvalue {lowest:g}")
    lower, upper = data["lb"], data["ub"]
    if np.any(np.isnan(lower)) or np.any(np.isnan(upper)):
        raise NotFiniteError("qp.at: bounds")
    for i in np.flatnonzero((lower > upper) | (lower == np.inf) | (upper == -np.inf)):
        raise InfeasibleQpError(
            f"qp.at: bound {i} is empty, [{lower[i]:g}, {upper[i]:g}]; "
            "with the limits (10) this means a position outside its limits"
        )
