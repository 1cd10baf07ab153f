"""Method "smt": no real numbers break the goal, says an SMT solver.

The graph is translated here to SMT-LIB, anew, and every solver that the payload
``{"solvers": ["z3", ..]}`` names must answer "unsat" in a process of its own.
Every value is a constant of its own with its defining equation; an operation
with cases (fmin, fabs, comparisons) is defined by implications.  An angle is
its sine and cosine, s^2 + c^2 = 1, and the addition theorems; which angle it is
is forgotten, so that only more points are allowed.  Trust: "smt".

Solvers are started here as the engines start theirs (``verification/engines``), in
lines written apart on purpose: the trusted base shares nothing with what it judges.
"""

from __future__ import annotations

import json
import math
import subprocess
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from rrnn_opt.check.claims.answer import Answer, undefined
from rrnn_opt.check.claims.document import WHERE, Bound, ClaimGraph, Step
from rrnn_opt.errors import DocumentError, UndecidedError

RUNNER = Path(__file__).with_name("smt_process.py")
SOLVERS = ("z3", "cvc5")
WALL_S = 120.0
"""Wall limit of one solver on one claim, s."""


def judge(graph: ClaimGraph, payload: Any, document: Any) -> Answer:
    """Ask the named solvers whether the goal can be broken.

    Raises:
        UndecidedError: an operation has no translation, a solver is not
            installed, or it does not answer "unsat" within the wall limit.
        DocumentError: the payload names no solvers.
    """
    solvers = payload.get("solvers") if isinstance(payload, dict) else None
    known = isinstance(solvers, list) and all(s in SOLVERS for s in solvers)
    if not (known and solvers and len(set(solvers)) == len(solvers)):
        raise DocumentError(WHERE, f"payload: solvers are some of {SOLVERS}")
    text = Script(graph)
    for solver in solvers:
        status = run(solver, text.lines, text.broken)
        if status != "unsat":
            raise UndecidedError(f"{solver} says {status}")
    reason = f"no real numbers break the goal, says {' and '.join(solvers)}"
    return Answer("PROVED", reason, "smt", undefined(tuple(sorted(text.partial))))


def run(solver: str, lines: Sequence[str], broken: Sequence[str]) -> str:
    """The solver's word on all the formulas of ``broken``: "unsat", or another."""
    job = {"solver": solver, "lines": list(lines), "broken": list(broken)}
    try:
        done = subprocess.run(
            [sys.executable, str(RUNNER)],
            input=json.dumps(job),
            capture_output=True,
            text=True,
            timeout=WALL_S,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return f"nothing within {WALL_S:g} s"
    words = done.stdout.split()
    if done.returncode != 0 or not words:
        return (done.stderr.strip().splitlines() or ["nothing at all"])[-1][:200]
    all_unsat = words == ["unsat"] * len(broken) and len(broken) > 0
    return "unsat" if all_unsat else next(w for w in (*words, "?") if w != "unsat")


class Script:
    """SMT-LIB lines of a graph, and the formulas that would break its goal.

    Attributes:
        lines: declarations and what is known.
        broken: one formula an element of the goal.
        partial: operations met that are not defined everywhere.

    Raises:
        UndecidedError: an operation or constant has no translation.
    """

    def __init__(self, graph: ClaimGraph) -> None:
        self.graph = graph
        self.lines: list[str] = []
        self.partial: set[str] = set()
        self.circles: dict[int, tuple[str, str]] = {}
        self.steps = {step.out: step for step in graph.steps if step.op != "output"}
        for i, port in enumerate(graph.inputs):
            for k in range(port.size):
                self._declare(f"in_{i}_{k}", *graph.domain.get((i, k), (None, None)))
        for step in self.steps.values():
            self._value(step)
        outputs = [["0.0"] * port.size for port in graph.outputs]
        for step in graph.steps:
            if step.op == "output" and step.slot is not None:
                outputs[step.slot[0]][step.slot[1]] = f"t{step.args[0]}"
        for sense, row in zip(graph.senses[1:], outputs[1:], strict=True):
            self._say(*(_KEPT[sense].format(x) for x in row))
        self.broken = [_BROKEN[graph.senses[0]].format(x) for x in outputs[0]]

    def _say(self, *formulas: str) -> None:
        self.lines += [f"(assert {formula})" for formula in formulas]

    def _declare(self, name: str, low: Bound = None, high: Bound = None) -> str:
        self.lines.append(f"(declare-fun {name} () Real)")
        if low is not None:
            self._say(f"(<= {_number(low)} {name})")
        if high is not None:
            self._say(f"(<= {name} {_number(high)})")
        return name

    def _value(self, step: Step) -> None:
        me = self._declare(f"t{step.out}")
        args = [f"t{a}" for a in step.args]
        if step.slot is not None:
            self._say(f"(= {me} in_{step.slot[0]}_{step.slot[1]})")
        elif step.const is not None:
            self._say(f"(= {me} {_number(step.const)})")
        elif step.op in ("sin", "cos"):
            self._say(f"(= {me} {self._circle(step.args[0])[step.op == 'cos']})")
        elif step.op == "pow":
            self._say(f"(= {me} {self._power(step)})")
        elif step.op in _MEANING and _ARITY[step.op] == len(args):
            self._say(*_MEANING[step.op](me, *args))
            if step.op in ("div", "inv", "sqrt") and not self._by_number(step):
                self.partial.add(step.op)
        else:
            raise UndecidedError(f"operation '{step.op}' is not known to this method")

    def _by_number(self, step: Step) -> bool:
        """Whether a quotient divides by a number that is not 0."""
        divisor = self.steps[step.args[-1]].const
        return step.op != "sqrt" and divisor is not None and divisor != 0.0

    def _power(self, step: Step) -> str:
        exponent = self.steps[step.args[1]].const
        if exponent is None or exponent not in range(1, 17):
            raise UndecidedError("a power without a whole exponent from 1 to 16")
        return " ".join(["(*", *[f"t{step.args[0]}"] * int(exponent), "1.0)"])

    def _circle(self, angle: int) -> tuple[str, str]:
        """Sine and cosine of value ``angle``."""
        if angle in self.circles:
            return self.circles[angle]
        s, c = self._declare(f"sin{angle}"), self._declare(f"cos{angle}")
        self.circles[angle] = s, c
        step = self.steps[angle]
        parts = [self._circle(a) for a in step.args] if step.op in _SUMS else []
        if step.op == "neg" and parts:
            ((a, b),) = parts
            self._say(f"(= {s} (- {a}))", f"(= {c} {b})")
        elif parts:
            (a, b), (d, e) = (parts * 2)[:2]
            first, second = ("-", "+") if step.op == "sub" else ("+", "-")
            self._say(f"(= {s} ({first} (* {a} {e}) (* {b} {d})))")
            self._say(f"(= {c} ({second} (* {b} {e}) (* {a} {d})))")
        elif step.const == 0:
            self._say(f"(= {s} 0.0)", f"(= {c} 1.0)")
        else:
            self._say(f"(= (+ (* {s} {s}) (* {c} {c})) 1.0)")
        return s, c


def _number(value: Any) -> str:
    """A number of SMT-LIB, exactly."""
    if isinstance(value, float) and not math.isfinite(value):
        raise UndecidedError(f"the constant {value} is not a real number")
    above, below = value.as_integer_ratio()
    quotient = f"(/ {abs(above)}.0 {below}.0)"
    return f"(- {quotient})" if above < 0 else quotient


def _cases(me: str, condition: str, yes: str, no: str) -> tuple[str, str]:
    return f"(=> {condition} (= {me} {yes}))", f"(=> (not {condition}) (= {me} {no}))"


def _simple(template: str) -> Callable[..., tuple[str, ...]]:
    return lambda me, *args: (f"(= {me} {template.format(*args)})",)


def _flag(template: str) -> Callable[..., tuple[str, ...]]:
    return lambda me, *args: _cases(me, template.format(*args), "1.0", "0.0")


_SUMS = ("add", "sub", "twice", "neg")
_KEPT = {
    "==0": "(= {} 0.0)", ">=0": "(>= {} 0.0)", "<=0": "(<= {} 0.0)",
    ">0": "(> {} 0.0)", "<0": "(< {} 0.0)",
}  # fmt: skip
_BROKEN = {
    "==0": "(distinct {} 0.0)", ">=0": "(< {} 0.0)", "<=0": "(> {} 0.0)",
    ">0": "(<= {} 0.0)", "<0": "(>= {} 0.0)",
}  # fmt: skip
_MEANING: dict[str, Callable[..., tuple[str, ...]]] = {
    "add": _simple("(+ {} {})"),
    "sub": _simple("(- {} {})"),
    "mul": _simple("(* {} {})"),
    "neg": _simple("(- {})"),
    "sq": _simple("(* {0} {0})"),
    "twice": _simple("(+ {0} {0})"),
    "fmin": lambda me, a, b: _cases(me, f"(< {a} {b})", a, b),
    "fmax": lambda me, a, b: _cases(me, f"(< {a} {b})", b, a),
    "fabs": lambda me, a: _cases(me, f"(< {a} 0.0)", f"(- {a})", a),
    "sign": lambda me, a: (
        f"(=> (< {a} 0.0) (= {me} (- 1.0)))",
        f"(=> (= {a} 0.0) (= {me} 0.0))",
        f"(=> (> {a} 0.0) (= {me} 1.0))",
    ),
    "floor": _simple("(to_real (to_int {}))"),
    "ceil": _simple("(- (to_real (to_int (- {}))))"),
    "lt": _flag("(< {} {})"),
    "le": _flag("(<= {} {})"),
    "eq": _flag("(= {} {})"),
    "ne": _flag("(distinct {} {})"),
    "not": _flag("(= {} 0.0)"),
    "and": _flag("(and (distinct {} 0.0) (distinct {} 0.0))"),
    "or": _flag("(or (distinct {} 0.0) (distinct {} 0.0))"),
    "if_else_zero": lambda me, a, b: _cases(me, f"(= {a} 0.0)", "0.0", b),
    "div": lambda me, a, b: (f"(= (* {me} {b}) {a})", f"(distinct {b} 0.0)"),
    "inv": lambda me, a: (f"(= (* {me} {a}) 1.0)",),
    "sqrt": lambda me, a: (f"(= (* {me} {me}) {a})", f"(<= 0.0 {me})"),
}
_ONE = ("neg", "sq", "twice", "fabs", "sign", "floor", "ceil", "not", "inv", "sqrt")
_ARITY = {op: 1 if op in _ONE else 2 for op in _MEANING}
