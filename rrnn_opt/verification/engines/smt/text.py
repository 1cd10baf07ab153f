"""A claim's negation as SMT-LIB text, for the finder.

Real arithmetic, constants exact.  fmin, fmax, fabs, sign and comparisons become
if-then-else.  Sine and cosine of an angle become a pair (s, c) with
s^2 + c^2 = 1; pairs of sums, differences and negatives follow from the addition
theorems.  That forgets which angle it was: "unsat" is kept, a model is only a
candidate.  Where a quotient or root may be undefined it is taken to be defined.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction

from rrnn_opt.claim import Claim
from rrnn_opt.errors import UndecidedError
from rrnn_opt.symbolic.tape import Instruction, Tape

MAX_POWER = 16


@dataclass
class SmtText:
    """One query, element by element of the goal.

    Attributes:
        common: declarations, domain and hypotheses.
        negations: one formula an element of the goal; all unsat: proved.
        names: SMT name by (variable, element).
        pairs: names (s, c) by number of the value that is the angle.
        tape: the claim's tape.
    """

    tape: Tape
    common: list[str] = field(default_factory=list)
    negations: list[str] = field(default_factory=list)
    names: dict[tuple[int, int], str] = field(default_factory=dict)
    pairs: dict[int, tuple[str, str]] = field(default_factory=dict)


def smt_text(claim: Claim) -> SmtText:
    """Translate a claim.

    Raises:
        UndecidedError: an operation or constant has no translation.
        UnsupportedOperationError: the graph holds an unknown operation.
    """
    writer = _Writer(Tape.of(claim.function()))
    writer.inputs()
    writer.domain(claim)
    for step in writer.tape.instructions[: writer.tape.n_values]:
        writer.define(step)
    return writer.finished(claim)


def real(value: Fraction) -> str:
    """A rational number in SMT-LIB."""
    size = f"{abs(value.numerator)}.0"
    if value.denominator != 1:
        size = f"(/ {size} {value.denominator}.0)"
    return f"(- {size})" if value < 0 else size


class _Writer(SmtText):
    """Builds the text value by value."""

    def inputs(self) -> None:
        for i, port in enumerate(self.tape.inputs):
            for k in range(port.size):
                self.names[i, k] = f"x{i}_{k}"
                self.common.append(f"(declare-const x{i}_{k} Real)")

    def domain(self, claim: Claim) -> None:
        index = {port.name: i for i, port in enumerate(self.tape.inputs)}
        for interval in claim.domain:
            i = index[interval.variable]
            for k, low in enumerate(interval.lower):
                if low is not None:
                    self.require(f"(>= x{i}_{k} {real(Fraction(low))})")
            for k, high in enumerate(interval.upper):
                if high is not None:
                    self.require(f"(<= x{i}_{k} {real(Fraction(high))})")

    def require(self, formula: str) -> None:
        self.common.append(f"(assert {formula})")

    def fresh(self, name: str) -> str:
        self.common.append(f"(declare-const {name} Real)")
        return name

    def define(self, step: Instruction) -> None:
        if step.op in ("sin", "cos"):
            text = self.pair(step.args[0])[step.op == "cos"]
        elif step.slot is not None:
            text = self.names[step.slot]
        elif step.const is not None:
            text = _constant(step.const)
        elif step.op in _PARTIAL:
            text = self.fresh(f"r{step.out}")
            for formula in _PARTIAL[step.op](text, *(f"v{a}" for a in step.args)):
                self.require(formula)
        elif step.op == "pow":
            text = self.power(step)
        elif step.op in _TOTAL:
            text = _TOTAL[step.op](*(f"v{a}" for a in step.args))
        else:
            raise UndecidedError(f"operation '{step.op}' has no translation to SMT")
        self.common.append(f"(define-fun v{step.out} () Real {text})")

    def power(self, step: Instruction) -> str:
        exponent = self.tape.instructions[step.args[1]].const
        if exponent is None or exponent not in range(1, MAX_POWER + 1):
            raise UndecidedError("a power without a small whole exponent")
        return f"(* 1.0 {' '.join([f'v{step.args[0]}'] * int(exponent))})"

    def pair(self, value: int) -> tuple[str, str]:
        """Names of (sin, cos) of a value."""
        if value not in self.pairs:
            self.pairs[value] = self.new_pair(value)
        return self.pairs[value]

    def new_pair(self, value: int) -> tuple[str, str]:
        step = self.tape.instructions[value]
        s, c = f"s{value}", f"c{value}"
        if step.op == "const" and step.const == 0:
            return "0.0", "1.0"
        if step.op == "neg":
            sine, cosine = self.pair(step.args[0])
            return f"(- {sine})", cosine
        if step.op in ("add", "sub", "twice"):
            (s1, c1), (s2, c2) = (self.pair(a) for a in (*step.args, *step.args)[:2])
            plus, minus = ("-", "+") if step.op == "sub" else ("+", "-")
            sine = f"({plus} (* {s1} {c2}) (* {c1} {s2}))"
            cosine = f"({minus} (* {c1} {c2}) (* {s1} {s2}))"
            self.common.append(f"(define-fun {s} () Real {sine})")
            self.common.append(f"(define-fun {c} () Real {cosine})")
            return s, c
        self.fresh(s), self.fresh(c)
        self.require(f"(= (+ (* {s} {s}) (* {c} {c})) 1.0)")
        return s, c

    def finished(self, claim: Claim) -> SmtText:
        results = [["0.0"] * port.size for port in self.tape.outputs]
        for step in self.tape.instructions[self.tape.n_values :]:
            if step.slot is not None:
                results[step.slot[0]][step.slot[1]] = f"v{step.args[0]}"
        senses = [relation.sense for relation in claim.relations]
        for row, sense in zip(results[1:], senses[1:], strict=True):
            for value in row:
                self.require(_holds(value, sense))
        self.negations = [f"(not {_holds(value, senses[0])})" for value in results[0]]
        return self


def _holds(value: str, sense: str) -> str:
    return f"({sense.rstrip('0').replace('==', '=')} {value} 0.0)"


def _constant(value: float) -> str:
    if not math.isfinite(value):
        raise UndecidedError(f"the constant {value} is not a real number")
    return real(Fraction(value))


def _truth(formula: str) -> str:
    return f"(ite {formula} 1.0 0.0)"


_TOTAL: dict[str, Callable[..., str]] = {
    "add": lambda a, b: f"(+ {a} {b})",
    "sub": lambda a, b: f"(- {a} {b})",
    "mul": lambda a, b: f"(* {a} {b})",
    "neg": lambda a: f"(- {a})",
    "sq": lambda a: f"(* {a} {a})",
    "twice": lambda a: f"(* 2.0 {a})",
    "fmin": lambda a, b: f"(ite (<= {a} {b}) {a} {b})",
    "fmax": lambda a, b: f"(ite (<= {a} {b}) {b} {a})",
    "fabs": lambda a: f"(ite (>= {a} 0.0) {a} (- {a}))",
    "sign": lambda a: f"(ite (> {a} 0.0) 1.0 (ite (< {a} 0.0) (- 1.0) 0.0))",
    "floor": lambda a: f"(to_real (to_int {a}))",
    "ceil": lambda a: f"(- (to_real (to_int (- {a}))))",
    "lt": lambda a, b: _truth(f"(< {a} {b})"),
    "le": lambda a, b: _truth(f"(<= {a} {b})"),
    "eq": lambda a, b: _truth(f"(= {a} {b})"),
    "ne": lambda a, b: _truth(f"(not (= {a} {b}))"),
    "not": lambda a: _truth(f"(= {a} 0.0)"),
    "and": lambda a, b: _truth(f"(not (or (= {a} 0.0) (= {b} 0.0)))"),
    "or": lambda a, b: _truth(f"(not (and (= {a} 0.0) (= {b} 0.0)))"),
    "if_else_zero": lambda a, b: f"(ite (= {a} 0.0) 0.0 {b})",
}
_PARTIAL: dict[str, Callable[..., tuple[str, ...]]] = {
    "div": lambda r, a, b: (f"(= (* {r} {b}) {a})", f"(not (= {b} 0.0))"),
    "inv": lambda r, a: (f"(= (* {r} {a}) 1.0)",),
    "sqrt": lambda r, a: (f"(= (* {r} {r}) {a})", f"(>= {r} 0.0)"),
}
