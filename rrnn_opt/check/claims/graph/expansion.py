"""The polynomial of every value of a graph, operation by operation."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

from flint import Ordering, fmpq, fmpq_mpoly_ctx

from rrnn_opt.check.claims.document import ClaimGraph, Step
from rrnn_opt.errors import UndecidedError

Polynomial = Any  # flint.fmpq_mpoly: python-flint has no usable stubs

MAX_EXPONENT = 64

TOTAL = {
    "fabs": 1, "sign": 1, "floor": 1, "ceil": 1, "exp": 1, "expm1": 1, "atan": 1,
    "sinh": 1, "cosh": 1, "tanh": 1, "not": 1, "fmin": 2, "fmax": 2,
    "lt": 2, "le": 2, "eq": 2, "ne": 2, "and": 2, "or": 2, "if_else_zero": 2,
    "hypot": 2,
}  # fmt: skip

PARTIAL = {
    "div": 2, "inv": 1, "sqrt": 1, "log": 1, "log1p": 1, "tan": 1, "asin": 1,
    "acos": 1, "pow": 2, "atan2": 2,
    "copysign": 2,
}  # fmt: skip

_SYMMETRIC = frozenset({"fmin", "fmax", "eq", "ne", "and", "or", "hypot"})

_ARITY = (
    TOTAL
    | PARTIAL
    | {"input": 0, "const": 0, "neg": 1, "sq": 1, "twice": 1, "sin": 1, "cos": 1}
    | {"add": 2, "sub": 2, "mul": 2}
)


def may_be_undefined(op: str) -> bool:
    """Whether an operation is not defined for all operands."""
    return op in PARTIAL


def remainder(p: Polynomial, circles: Sequence[tuple[int, Polynomial]]) -> Polynomial:
    """A polynomial with every square of a cosine replaced, (c^2 = 1 - s^2)."""
    degrees = p.degrees()
    for cosine, circle in circles:
        if degrees[cosine] > 1:
            p = p % circle
    return p


class Expansion:
    """The polynomial of every value so far, and the generators in use."""

    def __init__(self, graph: ClaimGraph, work: int) -> None:
        count = sum(_generators(s.op) for s in graph.steps)
        names = [f"g{k}" for k in range(count)]
        self.ring = fmpq_mpoly_ctx.get(names, Ordering.lex)
        self.free = list(reversed(range(count)))
        self.budget = work
        self.values: dict[int, Polynomial] = {}
        self.results: dict[tuple[int, int], Polynomial] = {}
        self.variables: dict[int, tuple[int, int]] = {}
        self.partial: set[str] = set()
        self.inputs: dict[tuple[int, int], Polynomial] = {}
        self.angles: list[tuple[Polynomial, Polynomial, Polynomial]] = []
        self.circles: list[tuple[int, Polynomial]] = []
        self.atoms: list[tuple[str, tuple[Polynomial, ...], Polynomial]] = []

    def value(self, step: Step) -> Polynomial:
        """The polynomial of one operation.

        Raises:
            UndecidedError: the operation is not known here.
        """
        if _ARITY.get(step.op, -1) != len(step.args):
            raise UndecidedError(f"operation '{step.op}' is not known to this method")
        args = [self.values[a] for a in step.args]
        if step.slot is not None:
            return self.input(step.slot)
        if step.const is not None:
            return self.constant(step.const)
        if step.op in _RULES:
            return _RULES[step.op](self, *args)
        return self.atom(step.op, args)

    def generator(self) -> tuple[int, Polynomial]:
        """Number and polynomial of a generator that nothing uses yet."""
        index = self.free.pop()
        return index, self.ring.gen(index)

    def input(self, slot: tuple[int, int]) -> Polynomial:
        """The generator of one element of a variable."""
        if slot not in self.inputs:
            index, self.inputs[slot] = self.generator()
            self.variables[index] = slot
        return self.inputs[slot]

    def constant(self, value: float) -> Polynomial:
        """The rational number that a double is.

        Raises:
            UndecidedError: it is not finite.
        """
        if not math.isfinite(value):
            raise UndecidedError(f"the constant {value} is not a real number")
        return self.ring.constant(fmpq(*value.as_integer_ratio()))

    def multiply(self, a: Polynomial, b: Polynomial) -> Polynomial:
        """The product in normal form, paid for from the budget.

        Raises:
            UndecidedError: the budget is spent.
        """
        self.budget -= len(a) * len(b)
        if self.budget < 0:
            raise UndecidedError("the expansion is too large (its budget is spent)")
        return self.reduced(a * b)

    def reduced(self, p: Polynomial) -> Polynomial:
        """Remainder by the relations c^2 + s^2 - 1."""
        rest = remainder(p, self.circles)
        self.budget -= len(rest) if self.circles else 0
        return rest

    def pair(self, angle: Polynomial) -> tuple[Polynomial, Polynomial]:
        """(sin, cos) of an angle; sin(-a) = -sin(a), cos(-a) = cos(a)."""
        if angle == 0:
            return self.ring.constant(0), self.ring.constant(1)
        if angle.leading_coefficient() < 0:
            sine, cosine = self.pair(-angle)
            return -sine, cosine
        for known, sine, cosine in self.angles:
            if known == angle:
                return sine, cosine
        index, cosine = self.generator()
        _, sine = self.generator()
        self.angles.append((angle, sine, cosine))
        self.circles.append((index, cosine * cosine + sine * sine - 1))
        return sine, cosine

    def atom(self, op: str, args: Sequence[Polynomial]) -> Polynomial:
        """The generator that stands for ``op(args)``, whatever its value is."""
        if op in PARTIAL:
            self.partial.add(op)
        operands = tuple(args)
        swapped = operands[::-1] if op in _SYMMETRIC else operands
        for name, known, atom in self.atoms:
            if name == op and known in (operands, swapped):
                return atom
        atom = self.generator()[1]
        self.atoms.append((op, operands, atom))
        return atom

    def quotient(self, a: Polynomial, b: Polynomial) -> Polynomial:
        """``a / b``: exact by a constant, else a times an atom.

        Raises:
            UndecidedError: b is 0.
        """
        if not b.is_constant():
            return self.multiply(a, self.atom("inv", [b]))
        if b == 0:
            raise UndecidedError("the graph divides by zero")
        return a * (1 / b.leading_coefficient())

    def power(self, base: Polynomial, exponent: Polynomial) -> Polynomial:
        """A product for small whole exponents, else an atom."""
        if exponent == 0:
            return self.ring.constant(1)
        n = exponent.leading_coefficient() if exponent.is_constant() else None
        if n is None or n.q != 1 or not 0 < n <= MAX_EXPONENT:
            return self.atom("pow", [base, exponent])
        result = base
        for _ in range(int(n) - 1):
            result = self.multiply(result, base)
        return result

    def extreme(self, op: str, a: Polynomial, b: Polynomial) -> Polynomial:
        """``fmin`` or ``fmax``, settled where the operands differ by a constant."""
        if a == b:
            return a
        if (a - b).is_constant():
            smaller, larger = (a, b) if (a - b).leading_coefficient() < 0 else (b, a)
            return smaller if op == "fmin" else larger
        return self.atom(op, [a, b])


def _generators(op: str) -> int:
    """How many generators an operation can ask for."""
    return 2 if op in ("sin", "cos") else int(op not in _RINGS)


_RINGS = frozenset({"add", "sub", "neg", "twice", "mul", "sq", "const", "output"})

_RULES: dict[str, Callable[..., Polynomial]] = {
    "add": lambda e, a, b: a + b,
    "sub": lambda e, a, b: a - b,
    "neg": lambda e, a: -a,
    "twice": lambda e, a: a + a,
    "mul": Expansion.multiply,
    "sq": lambda e, a: e.multiply(a, a),
    "sin": lambda e, a: e.pair(a)[0],
    "cos": lambda e, a: e.pair(a)[1],
    "div": Expansion.quotient,
    "inv": lambda e, a: e.quotient(e.ring.constant(1), a),
    "pow": Expansion.power,
    "fmin": lambda e, a, b: e.extreme("fmin", a, b),
    "fmax": lambda e, a, b: e.extreme("fmax", a, b),
}
