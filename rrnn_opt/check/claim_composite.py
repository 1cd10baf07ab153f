"""Proofs made of proofs: lemmas, instances of them, and named rules.

A composite certificate has ``"method": "composite"`` and the payload::

    {"parts": [certificates, each judged again here],
     "rules": ["pen: ...", ...],      steps that nothing checks: assumptions
     "combination": null or
        {"inputs", "outputs", "tape": expressions over the claim's variables,
         "elements": [[term, ...], ...]}}    one list for each goal element

The claim is established either by a part that has its fingerprint, or by a
combination: every element of the goal is a sum of terms, plus what is seen to
have the claimed sign term by term (nothing, for an equation).  The terms::

    {"use": "lemma", "part": k, "element": j, "arguments": [ref, ...],
     "factor": ref}          factor * goal_j of part k, at these arguments
    {"use": "hypothesis", "output": i, "element": j, "factor": ref}
    {"use": "square", "of": ref, "factor": ref}

A ref is the number of an expression.  Factors are never negative, seen term by
term, unless what they multiply is an equation.  The hypotheses and the domain
of a lemma must hold at its arguments: each is seen term by term, or exceeds a
hypothesis of the claim by what is.

Assumptions of all parts and the rules are united, and the weakest trust wins.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from flint import fmpq

from rrnn_opt.check.assembly import Assembly
from rrnn_opt.check.claim_answer import Answer, undefined, weakest
from rrnn_opt.check.claim_document import WHERE, ClaimGraph, Element, read_claim
from rrnn_opt.check.polynomial import NormalForms, Polynomial, normal_forms
from rrnn_opt.check.term_signs import never_negative
from rrnn_opt.errors import DocumentError, UndecidedError

MAX_PARTS = 32
Part = tuple[str, str, tuple[str, ...], str]
"""Status, reason, assumptions and trust of a part."""
Judge = Callable[[Mapping[str, Any]], Part]


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


def judge(graph: ClaimGraph, payload: Mapping[str, Any], judged: Judge) -> Answer:
    """Find a composite proof again.

    Args:
        graph: the claim.
        payload: see the module.
        judged: the checker of one certificate, for the parts.

    Raises:
        UndecidedError: the parts do not make a proof of the claim.
        DocumentError: the payload is not readable.
    """
    try:
        lemmas = _lemmas(payload["parts"], judged)
        rules = tuple(str(rule) for rule in payload["rules"])
        partial, reason = _established(graph, payload["combination"], lemmas)
    except (KeyError, TypeError, ValueError, IndexError) as error:
        raise DocumentError(WHERE, f"proof not readable ({error!r})") from error
    if not all(rule.startswith("pen: ") for rule in rules):
        raise DocumentError(WHERE, "a rule that is not checked begins with 'pen: '")
    united = [*(a for part in lemmas for a in part.assumptions), *undefined(partial)]
    fresh = [a for a in dict.fromkeys([*united, *rules]) if a not in graph.added]
    trust = weakest("pen" if rules else "exact", *(part.trust for part in lemmas))
    return Answer("PROVED", reason, trust, tuple(fresh))


def _established(
    graph: ClaimGraph, combination: Any, lemmas: Sequence[Lemma]
) -> tuple[tuple[str, ...], str]:
    """Operations that may be undefined, and how the claim follows."""
    if combination is not None:
        reason = f"a combination of {len(lemmas)} lemmas and the hypotheses"
        return _combine(graph, combination, lemmas), reason
    if all(part.graph.fingerprint != graph.fingerprint for part in lemmas):
        raise UndecidedError("no part is a proof of the claim")
    return (), f"proved as one of {len(lemmas)} parts"


def _combine(
    graph: ClaimGraph, data: Mapping[str, Any], lemmas: Sequence[Lemma]
) -> tuple[str, ...]:
    """Operations of the claim that are not defined everywhere."""
    pieces = read_claim(_as_claim(graph, data))
    if pieces.inputs != graph.inputs:
        raise UndecidedError("the expressions are not of the claim's variables")
    build = _Combination(graph, pieces, lemmas)
    if len(data["elements"]) != graph.outputs[0].size:
        raise UndecidedError("one list of terms for every element of the goal")
    for element, terms in enumerate(data["elements"]):
        build.element(element, terms)
    forms = normal_forms(build.assembly.graph())
    _Signs(graph, build, forms).require()
    return forms.partial


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


def _lemmas(documents: Sequence[Mapping[str, Any]], judged: Judge) -> tuple[Lemma, ...]:
    """Judge every part."""
    if len(documents) > MAX_PARTS:
        raise UndecidedError(f"at most {MAX_PARTS} parts are judged")
    lemmas = []
    for document in documents:
        block = document["claim"]
        status, reason, assumptions, trust = judged(document)
        if status not in ("PROVED", "HOLDS_UNDER"):
            raise UndecidedError(f"part '{block.get('id')}' is {status}: {reason}")
        lemmas.append(Lemma(read_claim(block), assumptions, trust))
    return tuple(lemmas)
