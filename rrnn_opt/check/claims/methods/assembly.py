"""One expression graph put together from several."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

from rrnn_opt.check.claims.document import ClaimGraph, Element, Port, Step
from rrnn_opt.check.claims.graph.expansion import may_be_undefined
from rrnn_opt.errors import UndecidedError

MAX_STEPS = 200_000


class Assembly:
    """Steps in order of evaluation, and one column of results.

    Args:
        inputs: the variables.
    """

    def __init__(self, inputs: Sequence[Port]) -> None:
        self._inputs = tuple(inputs)
        self._steps: list[Step] = []
        self._results: list[int] = []

    def variables(self) -> dict[Element, int]:
        """Value numbers of all elements of the variables.

        Raises:
            UndecidedError: the proof has more than MAX_STEPS steps.
        """
        found: dict[Element, int] = {}
        for index, port in enumerate(self._inputs):
            for k in range(port.size):
                found[index, k] = self._push("input", (), None, (index, k))
        return found

    def splice(
        self, graph: ClaimGraph, arguments: Mapping[Element, int]
    ) -> dict[Element, int]:
        """Add a graph with its variables replaced; its results by place.

        Raises:
            UndecidedError: the proof has more than MAX_STEPS steps.
        """
        values: list[int] = []
        results: dict[Element, int] = {}
        for step in graph.steps:
            if step.op == "output" and step.slot is not None:
                results[step.slot] = values[step.args[0]]
            elif step.op == "input" and step.slot is not None:
                values.append(arguments[step.slot])
            else:
                args = tuple(values[a] for a in step.args)
                values.append(self._push(step.op, args, step.const, None))
        return results

    def add(self, op: str, *args: int) -> int:
        """One more operation.

        Raises:
            UndecidedError: the proof has more than MAX_STEPS steps.
        """
        return self._push(op, args, None, None)

    def zero(self) -> int:
        """The constant 0.

        Raises:
            UndecidedError: the proof has more than MAX_STEPS steps.
        """
        return self._push("const", (), 0.0, None)

    def distance(self, value: int, bound: Fraction, order: int) -> int:
        """``value - bound`` for order 1, ``bound - value`` for order -1.

        Raises:
            UndecidedError: the bound has too many digits, or the proof has more
                than MAX_STEPS steps.
        """
        top = self._integer(bound.numerator)
        if bound.denominator != 1:
            top = self.add("div", top, self._integer(bound.denominator))
        return self.add("sub", *((value, top) if order > 0 else (top, value)))

    def result(self, value: int) -> int:
        """Ask for a value; its place in the column of results."""
        self._results.append(value)
        return len(self._results) - 1

    def ask_partial(self) -> None:
        """Ask for the value of every operation so far that may be undefined."""
        for step in self._steps:
            if may_be_undefined(step.op):
                self.result(step.out)

    def graph(self) -> ClaimGraph:
        """The whole, with one output."""
        steps = [
            Step("output", -1, (value,), None, (0, place))
            for place, value in enumerate(self._results)
        ]
        outputs = (Port("all", (len(self._results), 1)),)
        every = (*self._steps, *steps)
        return ClaimGraph(self._inputs, outputs, every, ("==0",), (), (), {}, "")

    def _integer(self, value: int) -> int:
        if abs(value) >= 2**53:
            raise UndecidedError("a bound of a lemma has too many digits")
        return self._push("const", (), float(value), None)

    def _push(
        self, op: str, args: tuple[int, ...], const: float | None, slot: Element | None
    ) -> int:
        if len(self._steps) >= MAX_STEPS:
            raise UndecidedError("the proof is too large")
        self._steps.append(Step(op, len(self._steps), args, const, slot))
        return len(self._steps) - 1
