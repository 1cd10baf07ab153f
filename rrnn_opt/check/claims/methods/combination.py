"""Sums of lemmas and hypotheses: is this the goal, and is each one used rightly?

See :mod:`rrnn_opt.check.claims.methods.composite` for how a combination is written.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from flint import fmpq

from rrnn_opt.check.claims.document import WHERE, ClaimGraph, Element, read_claim
from rrnn_opt.check.claims.graph.expansion import Polynomial
from rrnn_opt.check.claims.graph.polynomial import NormalForms, normal_forms
from rrnn_opt.check.claims.graph.term_signs import never_negative
from rrnn_opt.check.claims.methods.assembly import Assembly
from rrnn_opt.errors import DocumentError, UndecidedError


@dataclass(frozen=True)
class Lemma:
    """A part that was judged.

    Attributes:
        graph: its claim.
        assumptions: that it rests on.
        trust: that it has.
    """

    graph: ClaimGraph
    assumptions: tuple[str, ...]
    trust: str


def combine(
    graph: ClaimGraph, data: Mapping[str, Any], lemmas: Sequence[Lemma]
) -> tuple[str, ...]:
    """Ask that a combination proves the goal.

    Args:
        graph: the claim.
        data: the combination.
        lemmas: the judged parts.

    Returns:
        Operations of the claim that are not defined everywhere.

    Raises:
        UndecidedError: it does not prove the goal.
        DocumentError: it is not readable.
    """
    pieces = read_claim(_as_claim(graph, data))
    if pieces.inputs != graph.inputs:
        raise UndecidedError("the expressions are not of the claim's variables")
    build = _Combination(graph, pieces, lemmas)
    if len(data["elements"]) != graph.outputs[0].size:
        raise UndecidedError("one list of terms for every element of the goal")
    for element, terms in enumerate(data["elements"]):
        build.element(element, terms)
    build.assembly.ask_partial()
    forms = normal_forms(build.assembly.graph())
    if forms.partial_atoms != _own_partial(graph):
        raise UndecidedError(
            "an operation of a lemma or of the proof may be undefined where it is used:"
            " only those of the claim itself are assumed to be defined"
        )
    _Signs(graph, build, forms).require()
    return forms.partial


def _own_partial(graph: ClaimGraph) -> int:
    """Number of different values of the claim's graph that may be undefined."""
    assembly = Assembly(graph.inputs)
    assembly.splice(graph, assembly.variables())
    assembly.ask_partial()
    return normal_forms(assembly.graph()).partial_atoms


def _as_claim(graph: ClaimGraph, data: Mapping[str, Any]) -> dict[str, Any]:
    """The expressions in the form in which a claim is read."""
    block = {name: data[name] for name in ("inputs", "outputs", "tape")}
    count = len(data["outputs"])
    words: list[Any] = [["", "", False, False]] * (count - 1)
    plain = {"domain": [], "order": None, "jacobian": None, "hypotheses": words}
    return block | plain | {"senses": ["==0"] * count}


class _Combination:
    """One graph of everything that a combination speaks of."""

    def __init__(
        self, graph: ClaimGraph, pieces: ClaimGraph, lemmas: Sequence[Lemma]
    ) -> None:
        self.lemmas = lemmas
        self.graph = graph
        self.assembly = Assembly(graph.inputs)
        self.inputs = self.assembly.variables()
        self.own = self.assembly.splice(graph, self.inputs)
        self.pieces = self.assembly.splice(pieces, self.inputs)
        self.sign = {"==0": 1, ">=0": 1, ">0": 1, "<=0": -1, "<0": -1}
        self.rest: list[int] = []
        self.factors: list[int] = []
        self.needs: list[tuple[int, str]] = []
        self.given: list[tuple[int, str]] = []
        for output in range(1, len(graph.outputs)):
            for element in range(graph.outputs[output].size):
                value, sense = self._signed(graph, self.own, (output, element))
                self.given.append((self.assembly.result(value), sense))

    def element(self, element: int, terms: Sequence[Mapping[str, Any]]) -> None:
        """Goal - sum of terms, as a result whose sign is asked for."""
        value, _ = self._signed(self.graph, self.own, (0, element))
        for term in terms:
            base, sense = self._base(term)
            factor = self._ref(term["factor"])
            if sense != "==0":
                self.factors.append(self.assembly.result(factor))
            product = self.assembly.add("mul", factor, base)
            value = self.assembly.add("sub", value, product)
        self.rest.append(self.assembly.result(value))

    def _base(self, term: Mapping[str, Any]) -> tuple[int, str]:
        if term["use"] == "square":
            return self.assembly.add("sq", self._ref(term["of"])), ">=0"
        if term["use"] == "hypothesis":
            slot = int(term["output"]), int(term["element"])
            if not 1 <= slot[0] < len(self.graph.outputs):
                raise UndecidedError("no such hypothesis")
            return self._signed(self.graph, self.own, slot)
        if term["use"] != "lemma":
            raise DocumentError(WHERE, f"a term uses '{term['use']}'")
        lemma = self.lemmas[int(term["part"])].graph
        return self._instance(lemma, term["arguments"], int(term["element"]))

    def _instance(
        self, lemma: ClaimGraph, refs: Sequence[int], element: int
    ) -> tuple[int, str]:
        """A lemma's goal at arguments; what it needs there is noted."""
        slots = [
            (i, k) for i, port in enumerate(lemma.inputs) for k in range(port.size)
        ]
        if len(slots) != len(refs):
            raise UndecidedError("a lemma is used with too few or many arguments")
        at = {slot: self._ref(r) for slot, r in zip(slots, refs, strict=True)}
        values = self.assembly.splice(lemma, at)
        for output in range(1, len(lemma.outputs)):
            for k in range(lemma.outputs[output].size):
                value, sense = self._signed(lemma, values, (output, k))
                self.needs.append((self.assembly.result(value), sense))
        for slot, (low, high) in lemma.domain.items():
            for bound, order in ((low, 1), (high, -1)):
                if bound is not None:
                    gap = self.assembly.distance(at[slot], bound, order)
                    self.needs.append((self.assembly.result(gap), ">=0"))
        return self._signed(lemma, values, (0, element))

    def _signed(
        self, graph: ClaimGraph, values: Mapping[Element, int], slot: Element
    ) -> tuple[int, str]:
        """A result turned round so that it is '==0', '>=0' or '>0'."""
        sense = graph.senses[slot[0]]
        if not 0 <= slot[1] < graph.outputs[slot[0]].size:
            raise UndecidedError("no such element")
        value = values.get(slot)
        value = self.assembly.zero() if value is None else value
        if sense[0] == "<":
            return self.assembly.add("neg", value), ">" + sense[1:]
        return value, sense

    def _ref(self, ref: int) -> int:
        if int(ref) < 0:
            raise DocumentError(WHERE, "a reference is negative")
        value = self.pieces.get((int(ref), 0))
        return self.assembly.zero() if value is None else value


class _Signs:
    """The signs that a combination rests on."""

    def __init__(
        self, graph: ClaimGraph, build: _Combination, forms: NormalForms
    ) -> None:
        self.graph, self.build, self.forms = graph, build, forms

    def value(self, place: int) -> Polynomial:
        return self.forms.results.get((0, place), 0)

    def require(self) -> None:
        """All of them.

        Raises:
            UndecidedError: names the first that is not seen.
        """
        sense = self.graph.senses[0]
        for element, place in enumerate(self.build.rest):
            rest = self.value(place)
            if sense == "==0" and rest != 0:
                raise UndecidedError(f"element {element}: the terms do not sum up")
            if sense != "==0" and not self._never(rest, strict="=" not in sense):
                raise UndecidedError(f"element {element}: what is left may be negative")
        for place in self.build.factors:
            if not self._never(self.value(place)):
                raise UndecidedError("a factor may be negative")
        for place, needed in self.build.needs:
            if not self._follows(self.value(place), needed):
                raise UndecidedError("a lemma is used where its hypotheses may fail")

    def _never(self, polynomial: Polynomial, *, strict: bool = False) -> bool:
        return never_negative(polynomial, self.forms, self.graph.domain, strict=strict)

    def _follows(self, need: Polynomial, sense: str) -> bool:
        strict = sense == ">0"
        if need == 0 and not strict:
            return True
        for place, given in self.build.given:
            have = self.value(place)
            if given == "==0" and need - have == 0 and not strict:
                return True
            if sense == "==0" or given == "==0":
                continue
            enough = strict and given != ">0"
            if self._never(need - have, strict=enough):
                return True
        return sense != "==0" and (
            self._never(need, strict=strict) or self._in_range(need, strict)
        )

    def _in_range(self, need: Polynomial, strict: bool) -> bool:
        """``x - a`` or ``a - x`` for an element x whose range says so."""
        for generator, slot in self.forms.variables.items() if need != 0 else ():
            low, high = self.graph.domain.get(slot, (None, None))
            x = need.context().gen(generator)
            for bound, gap, sign in ((low, need - x, 1), (high, need + x, -1)):
                if bound is None or not gap.is_constant():
                    continue
                rest = gap.leading_coefficient() if gap != 0 else 0
                least = rest + sign * fmpq(bound.numerator, bound.denominator)
                if least > 0 or (least == 0 and not strict):
                    return True
        return False
