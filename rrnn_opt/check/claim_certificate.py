"""The judge of claims: the only place that says PROVED or REFUTED.

A certificate is a JSON document::

    {"kind": "rrnn_opt claim certificate", "schema": 1,
     "claim": {"id", "source", "statement", "fingerprint", "order", "jacobian",
               "inputs": [[name, [rows, columns]], ...],
               "outputs": [...],          goal, then hypotheses with a relation
               "tape": [[op, out, [args], constant as hex float, slot], ...],
               "senses": ["==0", ...],    one for every output
               "hypotheses": [[id, statement, in words only, not in the source]],
               "domain": [{"variable", "lower": ["1/2", null], "upper"}]},
     "method": "identity" | "terms" | "replay",
     "witness": {variable: ["p/q", ...]} or null,
     "status", "trust", "assumptions", "versions"}   what the finder says

The verdict is found again here from the tape alone.  identity: the normal form
of every element of the goal is 0.  terms: every term of it has one sign on the
domain.  replay: at the witness, which lies in the domain and keeps the
hypotheses, the goal is certainly broken.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import InitVar, dataclass
from fractions import Fraction
from importlib import metadata
from typing import Any, NoReturn, final

from flint import arb

from rrnn_opt.check.balls import replay
from rrnn_opt.check.claim_document import (
    WHERE,
    ClaimGraph,
    Element,
    read_claim,
    read_rational,
)
from rrnn_opt.check.polynomial import NormalForms, normal_forms
from rrnn_opt.check.term_signs import never_negative
from rrnn_opt.errors import DocumentError, RrnnError, UndecidedError

KIND = "rrnn_opt claim certificate"
PROVED, REFUTED = "PROVED", "REFUTED"
HOLDS_UNDER, UNKNOWN = "HOLDS_UNDER", "UNKNOWN"
_SEAL = object()


@final
@dataclass(frozen=True)
class CheckedCertificate:
    """The checker's answer; nothing else can make one.

    Attributes:
        status: PROVED, REFUTED, HOLDS_UNDER or UNKNOWN.
        reason: half a sentence.
        text: the document that was judged, as JSON.
        trust: "exact" or "arb"; "" when unknown.
        assumptions: what was assumed, for HOLDS_UNDER.
    """

    status: str
    reason: str
    text: str
    trust: str = ""
    assumptions: tuple[str, ...] = ()
    seal: InitVar[object] = None

    def __post_init__(self, seal: object) -> None:
        """Refuse any maker but this module.

        Raises:
            RrnnError: made elsewhere.
        """
        if seal is not _SEAL:
            raise RrnnError(
                "only check_certificate makes a verdict: give it a document"
            )

    def __reduce__(self) -> NoReturn:
        """Copies could be altered: pass the document on and check it again."""
        raise RrnnError("a checked certificate is not copied; send its document")

    @property
    def document(self) -> dict[str, Any]:
        """The document that was judged, as given (a fresh copy)."""
        document: dict[str, Any] = json.loads(self.text)
        return document

    @property
    def certificate(self) -> dict[str, Any]:
        """The document with this answer written into it."""
        answer = {
            "status": self.status,
            "trust": self.trust,
            "assumptions": list(self.assumptions),
            "versions": versions(),
        }
        return self.document | answer

    @property
    def fingerprint(self) -> str:
        """Fingerprint of the claim that was judged."""
        return str(self.document["claim"]["fingerprint"])

    @property
    def holds(self) -> bool:
        """Whether the claim is settled, and as the document says (if it does)."""
        said = self.document.get("status", self.status)
        return self.status != UNKNOWN and said == self.status

    @property
    def witness(self) -> dict[str, list[str]] | None:
        """The point that refutes, as exact numbers."""
        if self.status != REFUTED:
            return None
        witness: dict[str, list[str]] = self.document["witness"]
        return witness

    def to_dict(self) -> dict[str, Any]:
        """The answer as plain data."""
        names = ("status", "holds", "reason", "trust", "assumptions", "witness")
        return {name: getattr(self, name) for name in names}


def check_certificate(document: Mapping[str, Any]) -> CheckedCertificate:
    """Find the verdict of a certificate again.

    Args:
        document: see the module; it is not altered.

    Returns:
        The verdict; UNKNOWN with the reason when the document does not
        establish one (the tape is not the claim that its fingerprint names,
        the witness does not break the goal, the expansion is too large).

    Raises:
        DocumentError: the document is not a readable certificate.
    """
    try:
        text = json.dumps(document, sort_keys=True, allow_nan=False)
        data = json.loads(text)
        kind, method, block = data["kind"], data["method"], data["claim"]
        stated = block["fingerprint"]
    except (KeyError, TypeError, ValueError) as error:
        raise DocumentError(WHERE, f"not readable ({error!r})") from error
    if kind != KIND or method not in _METHODS:
        raise DocumentError(WHERE, f"kind '{kind}' or method '{method}' is unknown")
    graph = read_claim(block)
    if graph.fingerprint != stated:
        reason = "the tape is not that of the claim which the fingerprint names"
        return CheckedCertificate(UNKNOWN, reason, text, seal=_SEAL)
    try:
        return _METHODS[method](graph, data, text)
    except UndecidedError as error:
        return CheckedCertificate(UNKNOWN, error.reason, text, seal=_SEAL)


def versions() -> dict[str, str]:
    """Versions that a certificate records."""
    return {name: metadata.version(name) for name in ("rrnn_opt", "python-flint")}


def _identity(graph: ClaimGraph, data: Any, text: str) -> CheckedCertificate:
    """The goal's normal form is 0; hypotheses and domain are not needed."""
    if graph.senses[0] not in ("==0", ">=0", "<=0"):
        raise UndecidedError("an identity does not prove a strict inequality")
    forms = normal_forms(graph)
    left = {slot: p for slot, p in forms.results.items() if p != 0}
    if left:
        (_, element), polynomial = min(left.items())
        largest = arb(max(abs(c) for c in polynomial.coeffs())).str(2, radius=False)
        raise UndecidedError(
            f"{len(left)} of {graph.outputs[0].size} elements do not vanish; element"
            f" {element} keeps {len(polynomial)} terms, the largest coefficient"
            f" {largest}"
        )
    return _proved(graph, forms, "the normal form is identically 0", text)


def _terms(graph: ClaimGraph, data: Any, text: str) -> CheckedCertificate:
    """Every term of the goal has the sign that is claimed, on the domain."""
    sense = graph.senses[0]
    if sense == "==0":
        raise UndecidedError("signs of terms do not prove an equation")
    forms = normal_forms(graph)
    factor = 1 if sense in (">=0", ">0") else -1
    for element in range(graph.outputs[0].size):
        polynomial = forms.results.get((0, element), 0) * factor
        strict = "=" not in sense
        if not never_negative(polynomial, forms, graph.domain, strict=strict):
            raise UndecidedError(f"element {element}: the terms differ in sign")
    reason = "every term has the claimed sign on the domain"
    return _proved(graph, forms, reason, text)


def _proved(
    graph: ClaimGraph, forms: NormalForms, reason: str, text: str
) -> CheckedCertificate:
    assumptions = graph.added
    if forms.partial:
        met = ", ".join(forms.partial)
        assumptions += (f"D1: every operation of the graph is defined ({met})",)
    status = HOLDS_UNDER if assumptions else PROVED
    return CheckedCertificate(status, reason, text, "exact", assumptions, seal=_SEAL)


def _replay(graph: ClaimGraph, data: Any, text: str) -> CheckedCertificate:
    """The witness lies in the domain, keeps the hypotheses, breaks the goal."""
    if graph.worded:
        named = ", ".join(graph.worded)
        raise UndecidedError(f"hypotheses in words only ({named}) cannot be replayed")
    point = _point(graph, data.get("witness"))
    _require_domain(graph, point)
    seen = replay(graph, point)
    for signs, sense in zip(seen.signs[1:], graph.senses[1:], strict=True):
        if not all(sign in _KEEPS[sense] for sign in signs):
            raise UndecidedError("the witness breaks a hypothesis")
    for element, sign in enumerate(seen.signs[0]):
        if sign not in _KEEPS[graph.senses[0]]:
            value = seen.values[0][element]
            reason = f"at the witness element {element} of the goal is {value}"
            return CheckedCertificate(REFUTED, reason, text, seen.trust, seal=_SEAL)
    raise UndecidedError("the goal holds at the witness")


def _point(graph: ClaimGraph, witness: Any) -> dict[Element, Fraction]:
    point: dict[Element, Fraction] = {}
    try:
        for index, port in enumerate(graph.inputs):
            numbers = [read_rational(x) for x in witness[port.name]]
            if len(numbers) != port.size:
                raise ValueError(f"'{port.name}' has {port.size} elements")
            point.update({(index, k): x for k, x in enumerate(numbers)})
    except (KeyError, TypeError, ValueError, ZeroDivisionError) as error:
        raise DocumentError(WHERE, f"witness not readable ({error!r})") from error
    return point


def _require_domain(graph: ClaimGraph, point: Mapping[Element, Fraction]) -> None:
    for slot, (low, high) in graph.domain.items():
        x = point[slot]
        if (low is not None and x < low) or (high is not None and x > high):
            name = graph.inputs[slot[0]].name
            raise UndecidedError(f"the witness leaves the domain ('{name}')")


_KEEPS = {"==0": (0,), ">=0": (0, 1), "<=0": (-1, 0), ">0": (1,), "<0": (-1,)}
_METHODS = {"identity": _identity, "terms": _terms, "replay": _replay}
