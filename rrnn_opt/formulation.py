"""A redundancy-resolution scheme, declared once as a parametric convex QP."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

import casadi as ca
import numpy as np

from rrnn_opt.arguments import checked
from rrnn_opt.errors import NotFiniteError, RrnnError, ShapeError
from rrnn_opt.symbolic.lagrangian import Lagrangian
from rrnn_opt.symbolic.qp import QP
from rrnn_opt.symbolic.symbol import (
    Symbol,
    dense,
    require_declared,
    require_names,
    shape_of,
)
from rrnn_opt.symbolic.tape import fingerprint

Part = Any
"""An SX column; None may be given for a part that is absent, and becomes SX."""

Level = Literal["velocity", "acceleration", "increment"]
"""What the joint entries of a decision are."""


@checked()
@dataclass(frozen=True, eq=False)
class Formulation:
    """``min cost`` over u, s.t. ``equalities == 0, inequalities <= 0`` and bounds.

    Everything is checked here and nothing later: shapes, declared symbols, and
    that it is a convex QP for every value of the parameters.  A part may be None;
    afterwards all are dense SX, absent rows having no rows and absent bounds
    being infinite.

    Attributes:
        name: a C identifier.
        decision: u, (n, 1).
        parameters: all other symbols, in the order of C arguments.
        cost: (1, 1), quadratic in u with a constant Hessian.
        equalities: (p, 1), affine in u; zero is meant.
        inequalities: (m, 1), affine in u; not positive is meant.
        lower: (n, 1), free of u.
        upper: (n, 1), free of u.
        citation: where the scheme comes from.
        notes: where we differ, and what a user must know.
        level: what the first nv entries of u are, nv being the robot's
            coordinates: joint "velocity" (rad/s), "acceleration" (rad/s2) or
            the "increment" of one step (rad).  What follows them (slacks, the
            bound of a largest entry) goes to no joint.
        inverse: matrix whose inverse stands written out in the graph, such as
            "J J' + damping I"; empty when the scheme is free of inversion.

    Raises:
        ShapeError: a part has the wrong shape; nothing is ever broadcast.
        NotAQpError: a part is not what it must be; the message names the
            operation, the row and the subexpression.
        NotFiniteError: a bound is NaN.
        RrnnError: the name is no C identifier; an undeclared symbol, two of one
            name or of one variable; or an unknown level.
    """

    name: str
    decision: Symbol
    parameters: tuple[Symbol, ...]
    cost: ca.SX
    equalities: Part = None
    inequalities: Part = None
    lower: Part = None
    upper: Part = None
    citation: str = ""
    notes: str = ""
    level: Level = "velocity"
    inverse: str = ""

    def __post_init__(self) -> None:
        if not ca.Function.check_name(self.name):
            raise RrnnError(
                f"formulation '{self.name}': use a C identifier as its name, "
                "without two underscores together"
            )
        n = self.decision.size
        if self.decision.shape != (n, 1):
            raise ShapeError(f"{self.name}: decision", (n, 1), self.decision.shape)
        require_names((self.decision, *self.parameters), self.name)
        self._set("cost", dense(self.cost, (1, 1), f"{self.name}: cost"))
        self._set("equalities", self._rows("equalities", self.equalities))
        self._set("inequalities", self._rows("inequalities", self.inequalities))
        self._set("lower", self._side("lower", self.lower, -np.inf))
        self._set("upper", self._side("upper", self.upper, np.inf))
        for part in ("cost", "equalities", "inequalities", "lower", "upper"):
            symbols = (self.decision, *self.parameters)
            require_declared(getattr(self, part), symbols, f"{self.name}: {part}")
        self.qp  # noqa: B018  settles here and now whether this is a convex QP

    def _set(self, field: str, value: ca.SX) -> None:
        object.__setattr__(self, field, value)

    def _rows(self, part: str, value: ca.SX | None) -> ca.SX:
        if value is None:
            return ca.SX(0, 1)
        return dense(value, (shape_of(value)[0], 1), f"{self.name}: {part}")

    def _side(self, part: str, value: ca.SX | None, free: float) -> ca.SX:
        n = self.decision.size
        if value is None:
            return ca.SX(ca.repmat(free, n, 1))
        side = dense(value, (n, 1), f"{self.name}: {part}")
        if any(x.is_constant() and np.isnan(float(x)) for x in ca.vertsplit(side)):
            raise NotFiniteError(f"{self.name}: {part} (NaN)")
        return side

    @cached_property
    def qp(self) -> QP:
        """Standard form, symbolic in the parameters."""
        return QP.of(
            self.decision,
            self.parameters,
            cost=self.cost,
            equalities=self.equalities,
            inequalities=self.inequalities,
            lower=self.lower,
            upper=self.upper,
        )

    @cached_property
    def lagrangian(self) -> Lagrangian:
        """L, its gradient, the KKT residual and the monotone map."""
        return Lagrangian.of(
            self.qp,
            cost=self.cost,
            equalities=self.equalities,
            inequalities=self.inequalities,
        )

    def function(self) -> ca.Function:
        """The declaration: decision and parameters in; cost, rows, bounds out."""
        symbols = (self.decision, *self.parameters)
        parts = ["cost", "equalities", "inequalities", "lower", "upper"]
        outputs = [getattr(self, part) for part in parts]
        names = [s.name for s in symbols]
        inputs = [s.sx for s in symbols]
        may = {"allow_duplicate_io_names": True}
        return ca.Function(self.name, inputs, outputs, names, parts, may)

    @cached_property
    def fingerprint(self) -> str:
        """SHA-256 of the declaration's graph."""
        return fingerprint(self.function())
