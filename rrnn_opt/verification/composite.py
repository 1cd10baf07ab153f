"""Proofs put together from lemmas: which, where they are used, and what rules."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import casadi as ca

from rrnn_opt.check.claims.answer import UNKNOWN
from rrnn_opt.check.claims.certificate import check_certificate
from rrnn_opt.claim import Claim
from rrnn_opt.decay import DecayClaim
from rrnn_opt.errors import RrnnError, UndecidedError, UnsupportedOperationError
from rrnn_opt.symbolic.symbol import Symbol, require_declared
from rrnn_opt.symbolic.tape import Tape
from rrnn_opt.verification.certify import certify
from rrnn_opt.verification.document import (
    Witness,
    certificate_document,
    port_row,
    step_row,
)
from rrnn_opt.verification.engines.points.inhabit import inhabitant
from rrnn_opt.verification.verdict import Verdict


@dataclass(frozen=True, eq=False)
class Instance:
    """``factor * lemma(arguments) >= 0`` (or ``== 0``), one element of its goal.

    Attributes:
        lemma: number of the lemma.
        arguments: SX by variable of the lemma, in the claim's variables.
        element: of the lemma's goal.
        factor: scalar SX; not negative term by term, unless the lemma is an equation.
    """

    lemma: int
    arguments: Mapping[str, ca.SX]
    element: int = 0
    factor: ca.SX = field(default_factory=lambda: ca.SX(1))


@dataclass(frozen=True, eq=False)
class Given:
    """``factor * hypothesis``, one element of it.

    Attributes:
        hypothesis: number among those of the claim that have a relation, from 0.
        element: of it.
        factor: scalar SX; not negative term by term, unless it is an equation.
    """

    hypothesis: int
    element: int = 0
    factor: ca.SX = field(default_factory=lambda: ca.SX(1))


@dataclass(frozen=True, eq=False)
class Square:
    """``factor * of^2``.

    Attributes:
        of: scalar SX.
        factor: scalar SX; not negative term by term.
    """

    of: ca.SX
    factor: ca.SX = field(default_factory=lambda: ca.SX(1))


Term = Instance | Given | Square


@dataclass(frozen=True, eq=False)
class Proof:
    """A claim with the tree of lemmas that it is to be proved by.

    Attributes:
        claim: what is proved.
        lemmas: claims, or proofs of claims, each settled on its own.
        terms: one tuple for each element of the goal, which is the sum of its
            terms; empty when a lemma is the claim itself.
        rules: steps of the argument that no checker follows, in words; each
            stands among the assumptions as "pen: ...".
        example: a point that keeps the hypotheses, if the search finds none.
    """

    claim: Claim
    lemmas: tuple[Claim | Proof, ...] = ()
    terms: tuple[tuple[Term, ...], ...] = ()
    rules: tuple[str, ...] = ()
    example: Witness | None = None

    def settle(self, *, seed: int = 0) -> Verdict:
        """Settle the lemmas, then let the checker judge the whole.

        Args:
            seed: of the engines' searches.

        Returns:
            The verdict; UNKNOWN names the lemma or the step that failed.  A
            lemma that is the claim itself may refute it.

        Raises:
            RrnnError: a term uses a lemma that is not there or lacks an argument
                of it, or depends on what is no variable of the claim.
        """
        begin = time.perf_counter()
        fingerprint = self.claim.fingerprint
        verdicts = [self._part(lemma, seed) for lemma in self.lemmas]
        for lemma, verdict in zip(self.lemmas, verdicts, strict=True):
            if lemma is self.claim and verdict.status == "REFUTED":
                return verdict
        missing = [
            f"lemma '{_claim(lemma).id}': {verdict.status}, {verdict.reason}"
            for lemma, verdict in zip(self.lemmas, verdicts, strict=True)
            if verdict.status not in ("PROVED", "HOLDS_UNDER")
        ]
        if not missing:
            parts = [verdict.certificate for verdict in verdicts]
            try:
                checked = check_certificate(self.document(parts, seed=seed))
            except (UndecidedError, UnsupportedOperationError) as error:
                missing = [f"composite: {error}"]
            else:
                if checked.status != UNKNOWN:
                    elapsed = time.perf_counter() - begin
                    return Verdict(fingerprint, "composite", checked, (), elapsed)
                missing = [f"composite: {checked.reason}"]
        elapsed = time.perf_counter() - begin
        return Verdict(fingerprint, residue=tuple(missing), time_s=elapsed)

    def _part(self, lemma: Claim | Proof, seed: int) -> Verdict:
        """Settle a lemma; one that is the claim itself shares its example."""
        if lemma is self.claim and self.example is not None:
            return certify(self.claim, witnesses=(self.example,), seed=seed)
        return settle(lemma, seed=seed)

    def document(self, parts: Sequence[Any], *, seed: int = 0) -> dict[str, Any]:
        """The certificate that the checker is asked to judge.

        Args:
            parts: certificates of the lemmas, in order.
            seed: of the search for a point that keeps the hypotheses.

        Raises:
            RrnnError: as ``settle``.
        """
        payload = {
            "parts": list(parts),
            "rules": [f"pen: {rule}" for rule in self.rules],
            "combination": self._combination() if self.terms else None,
        }
        given = () if self.example is None else (self.example,)
        kept = inhabitant(self.claim, given, seed)
        document = certificate_document(self.claim, "composite", payload=payload)
        return document | {"witness": kept}

    def _combination(self) -> dict[str, Any]:
        pieces: list[ca.SX] = []
        elements = [[self._term(term, pieces) for term in row] for row in self.terms]
        symbols = self.claim.variables
        terms = ca.vertcat(ca.SX(0, 1), *pieces)
        require_declared(terms, symbols, f"{self.claim.id}: terms")
        names = [s.name for s in symbols]
        results = [f"e{k}" for k in range(len(pieces))]
        inputs = [s.sx for s in symbols]
        tape = Tape.of(ca.Function("pieces", inputs, pieces, names, results))
        return {
            "inputs": [port_row(port) for port in tape.inputs],
            "outputs": [port_row(port) for port in tape.outputs],
            "tape": [step_row(step) for step in tape.instructions],
            "elements": elements,
        }

    def _term(self, term: Term, pieces: list[ca.SX]) -> dict[str, Any]:
        def ref(value: ca.SX) -> int:
            pieces.append(ca.densify(ca.SX(value)))
            return len(pieces) - 1

        row: dict[str, Any] = {"factor": ref(term.factor)}
        if isinstance(term, Square):
            return row | {"use": "square", "of": ref(term.of)}
        if isinstance(term, Given):
            output = term.hypothesis + 1
            return row | {
                "use": "hypothesis",
                "output": output,
                "element": term.element,
            }
        variables = self._variables(term)
        columns = [ca.vec(ca.SX(term.arguments[s.name])) for s in variables]
        arguments = [ref(x) for column in columns for x in ca.vertsplit(column)]
        where = {"part": term.lemma, "element": term.element}
        return row | where | {"use": "lemma", "arguments": arguments}

    def _variables(self, term: Instance) -> tuple[Symbol, ...]:
        """Variables of the lemma that a term uses, if it has arguments for them."""
        if not 0 <= term.lemma < len(self.lemmas):
            count = len(self.lemmas)
            raise RrnnError(f"{self.claim.id}: lemma {term.lemma} of {count}, from 0")
        lemma = _claim(self.lemmas[term.lemma])
        names = {s.name for s in lemma.variables}
        if set(term.arguments) != names:
            listed = ", ".join(sorted(names))
            raise RrnnError(f"{self.claim.id}: lemma '{lemma.id}' is of {listed}")
        return lemma.variables


def settle(statement: Claim | DecayClaim | Proof, *, seed: int = 0) -> Verdict:
    """Settle a claim by the engines, or a proof by its lemmas.

    Args:
        statement: a claim, or a proof of one.
        seed: of the engines' searches.
    """
    if isinstance(statement, Proof):
        return statement.settle(seed=seed)
    return certify(statement, seed=seed)


def _claim(statement: Claim | Proof) -> Claim:
    return statement.claim if isinstance(statement, Proof) else statement
