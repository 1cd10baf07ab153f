"""Claims as data: a statement, the symbols it speaks of, and its hypotheses.

A claim settles nothing.  Engines that look for a proof or a counterexample
live elsewhere, and what they find is re-checked by code that shares nothing
with them.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.errors import ArgumentError, RrnnError, ShapeError
from rrnn_opt.symbolic.symbol import Symbol, require_declared, require_names
from rrnn_opt.symbolic.tape import fingerprint

SENSES = ("==0", ">=0", "<=0", ">0", "<0")
ORDERS = ("first-order", "second-order", "discrete")
JACOBIANS = ("frozen", "moving")


@checked()
@dataclass(frozen=True, eq=False)
class Relation:
    """``expression sense``, element by element, e.g. ``x'P(x) >= 0``.

    Attributes:
        expression: SX of any shape; all its elements must satisfy the sense.
        sense: "==0", ">=0", "<=0", ">0" or "<0".

    Raises:
        RrnnError: unknown sense, or an empty expression.
    """

    expression: ca.SX
    sense: str

    def __post_init__(self) -> None:
        if self.sense not in SENSES:
            raise RrnnError(f"relation '{self.sense}': use one of {', '.join(SENSES)}")
        if self.expression.numel() == 0:
            raise RrnnError("relation: the expression is empty")

    @property
    def strict(self) -> bool:
        """Whether equality with zero breaks it."""
        return self.sense in (">0", "<0")


@checked()
@dataclass(frozen=True, eq=False)
class Hypothesis:
    """An assumption under which a claim is made.

    Attributes:
        id: "A1", "A2", ..
        statement: in words.
        relation: what it says of the claim's variables; None when it cannot be
            said there (e.g. "noise is independent").
        added: whether the source does not state it; then the claim can at
            best hold under it.
    """

    id: str
    statement: str
    relation: Relation | None = None
    added: bool = False


def _fractions(name: str, bounds: Iterable[Any]) -> tuple[Fraction | None, ...]:
    try:
        return tuple(None if x is None else Fraction(x) for x in bounds)
    except (TypeError, ValueError, OverflowError) as error:
        raise ArgumentError(f"Range: {name}", f"expected numbers: {error}") from None


@checked(skip=["lower", "upper"])
@dataclass(frozen=True)
class Range:
    """A closed interval for every element of one variable.

    Attributes:
        variable: its name.
        lower: one bound an element, column-major; None for minus infinity.  Whole
            numbers and floats are taken for the fractions that they are.
        upper: one bound an element; None for plus infinity.

    Raises:
        ArgumentError: a bound is no finite number.
        ShapeError: there are more lower than upper bounds, or fewer.
        RrnnError: a lower bound exceeds its upper bound.
    """

    variable: str
    lower: tuple[Fraction | None, ...]
    upper: tuple[Fraction | None, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "lower", _fractions("lower", self.lower))
        object.__setattr__(self, "upper", _fractions("upper", self.upper))
        if len(self.lower) != len(self.upper):
            want, got = (len(self.lower),), (len(self.upper),)
            raise ShapeError(f"range of '{self.variable}': upper bounds", want, got)
        for low, high in zip(self.lower, self.upper, strict=True):
            if low is not None and high is not None and low > high:
                raise RrnnError(f"range of '{self.variable}': {low} exceeds {high}")


@checked()
@dataclass(frozen=True, eq=False)
class Claim:
    """For all variables in the domain: hypotheses imply the goal.

    Attributes:
        id: e.g. "C20a".
        source: where it is stated, e.g. "eq. (21)".
        statement: in words.
        variables: what it speaks of; every free variable is declared here.
        goal: the relation that is claimed.
        hypotheses: assumptions.
        domain: ranges of the variables; a variable without one is any real.
        order: "first-order", "second-order" or "discrete" dynamics, or None.
        jacobian: "frozen" or "moving", or None.

    Raises:
        RrnnError: unknown order or jacobian, an undeclared free variable, two
            variables of one name, or a range of an unknown variable.
        ShapeError: a range has the wrong number of elements.
    """

    id: str
    source: str
    statement: str
    variables: tuple[Symbol, ...]
    goal: Relation
    hypotheses: tuple[Hypothesis, ...] = ()
    domain: tuple[Range, ...] = ()
    order: str | None = None
    jacobian: str | None = None

    def __post_init__(self) -> None:
        if self.order not in (*ORDERS, None):
            raise RrnnError(f"{self.id}: order '{self.order}' is none of {ORDERS}")
        if self.jacobian not in (*JACOBIANS, None):
            raise RrnnError(f"{self.id}: '{self.jacobian}' is none of {JACOBIANS}")
        require_names(self.variables, self.id)
        require_declared(self.goal.expression, self.variables, f"{self.id}: goal")
        for hypothesis in self.hypotheses:
            if hypothesis.relation is not None:
                where = f"{self.id}: hypothesis {hypothesis.id}"
                expression = hypothesis.relation.expression
                require_declared(expression, self.variables, where)
        self._check_domain()

    def _check_domain(self) -> None:
        sizes = {s.name: s.size for s in self.variables}
        for interval in self.domain:
            if interval.variable not in sizes:
                raise RrnnError(f"{self.id}: no variable '{interval.variable}'")
            want, got = (sizes[interval.variable],), (len(interval.lower),)
            if want != got:
                where = f"{self.id}: range of '{interval.variable}'"
                raise ShapeError(where, want, got)

    @property
    def relations(self) -> tuple[Relation, ...]:
        """The goal, then the relations of the hypotheses that have one."""
        given = [h.relation for h in self.hypotheses if h.relation is not None]
        return (self.goal, *given)

    def function(self) -> ca.Function:
        """The graph: variables in, goal and hypothesis expressions out."""
        return ca.Function(
            "claim",
            [s.sx for s in self.variables],
            [ca.densify(r.expression) for r in self.relations],
            [s.name for s in self.variables],
            ["goal", *(f"hypothesis_{i + 1}" for i in range(len(self.relations) - 1))],
        )

    @property
    def fingerprint(self) -> str:
        """SHA-256 of what is claimed: graph, senses, domain, dynamics.

        Two claims of one fingerprint state the same of variables of the same
        names.  Of words only those are part of it that are assumed: what
        hypotheses say that the source does not state, or that have no relation.
        """
        names = [s.name for s in self.variables]
        ranges = sorted(
            (names.index(r.variable), [str(x) for x in (*r.lower, *r.upper)])
            for r in self.domain
        )
        content = [
            fingerprint(self.function()),
            [r.sense for r in self.relations],
            ranges,
            self.order,
            self.jacobian,
            [
                [(h.relation is None or h.added) and h.statement, h.added]
                for h in self.hypotheses
            ],
        ]
        return hashlib.sha256(json.dumps(content).encode()).hexdigest()
