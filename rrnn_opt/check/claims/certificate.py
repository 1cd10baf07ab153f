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
     "method": "identity" | "terms" | "replay" | ..,
     "payload": what the method needs, or null,
     "witness": {variable: ["p/q", ...]} or null,
     "status", "trust", "assumptions", "versions",   what the finder says
     "digest"}                         SHA-256 of all but versions and itself

The verdict is found again here from the claim and the payload alone, by the
module ``methods/<method>``.  The witness of a refutation breaks the
goal; the witness of a proof lies in the domain and keeps the hypotheses, so that
the proof is not of nothing.  It may be null where the claim has no hypotheses and
the proof no assumptions.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping
from dataclasses import InitVar, dataclass
from importlib import metadata
from typing import Any, NoReturn, final

from rrnn_opt.check.claims.answer import (
    HOLDS_UNDER,
    PROVED,
    REFUTED,
    UNKNOWN,
    Answer,
)
from rrnn_opt.check.claims.document import WHERE, ClaimGraph, read_claim
from rrnn_opt.check.claims.methods import (
    composite,
    identity,
    interval,
    lmi,
    point,
    replay,
    smt,
    sos,
    terms,
)
from rrnn_opt.check.claims.methods.composite import Part
from rrnn_opt.errors import DocumentError, RrnnError, UndecidedError

KIND = "rrnn_opt claim certificate"
_SEAL = object()


@final
@dataclass(frozen=True)
class CheckedCertificate:
    """The checker's answer; nothing else can make one.

    Attributes:
        status: PROVED, REFUTED, HOLDS_UNDER or UNKNOWN.
        reason: half a sentence.
        text: the document that was judged, as JSON.
        trust: "exact", "arb", "interval", "smt" or "pen"; "" when unknown.
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
        """Copies could be altered: pass the document on and check it again.

        Raises:
            RrnnError: always.
        """
        raise RrnnError("a checked certificate is not copied; send its document")

    @property
    def document(self) -> dict[str, Any]:
        """The document that was judged, as given (a fresh copy)."""
        document: dict[str, Any] = json.loads(self.text)
        return document

    @property
    def certificate(self) -> dict[str, Any]:
        """The document with this answer written into it."""
        whole = self.document | self._answer | {"versions": versions()}
        return whole | {"digest": digest(whole)}

    @property
    def fingerprint(self) -> str:
        """Fingerprint of the claim that was judged."""
        return str(self.document["claim"]["fingerprint"])

    @property
    def holds(self) -> bool:
        """Whether the claim is settled, and as the document says (if it does)."""
        said = self.document
        return self.status != UNKNOWN and all(
            said.get(name, value) == value for name, value in self._answer.items()
        )

    @property
    def _answer(self) -> dict[str, Any]:
        """What a document may say of itself."""
        assumptions = list(self.assumptions)
        return {"status": self.status, "trust": self.trust, "assumptions": assumptions}

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
    except (KeyError, TypeError, ValueError, RecursionError) as error:
        raise DocumentError(WHERE, f"not readable ({error!r})") from error
    form = str(block.get("form", "graph")) if isinstance(block, dict) else ""
    if kind != KIND or form not in FORMS or str(method) not in FORMS[form][1]:
        what = f"kind '{kind}', form '{form}' or method '{method}'"
        raise DocumentError(WHERE, f"{what} is unknown")
    read, methods = FORMS[form]
    graph = read(block)
    if data.get("digest", whole := digest(data)) != whole:
        reason = "the document was altered after it was made"
        return CheckedCertificate(UNKNOWN, reason, text, seal=_SEAL)
    if graph.fingerprint != stated:
        reason = "the tape is not that of the claim which the fingerprint names"
        return CheckedCertificate(UNKNOWN, reason, text, seal=_SEAL)
    try:
        answer = methods[str(method)](graph, data.get("payload"), data)
        status, assumptions = _settled(graph, answer, data)
    except (UndecidedError, RecursionError) as error:
        reason = getattr(error, "reason", "the proof is nested too deeply")
        return CheckedCertificate(UNKNOWN, reason, text, seal=_SEAL)
    return CheckedCertificate(
        status, answer.reason, text, answer.trust, assumptions, seal=_SEAL
    )


def _settled(
    graph: Any, answer: Answer, data: Mapping[str, Any]
) -> tuple[str, tuple[str, ...]]:
    """Status and assumptions; a proof must be of something."""
    if answer.status != PROVED:
        return REFUTED, answer.assumptions
    witness, assumptions = data.get("witness"), graph.added + answer.assumptions
    if not isinstance(graph, ClaimGraph):
        pass  # a linear system always has solutions
    elif witness is not None:
        replay.require_admitted(graph, witness)
    elif len(graph.senses) > 1 or assumptions:
        raise UndecidedError("no witness shows that the hypotheses can be kept")
    return (HOLDS_UNDER if assumptions else PROVED), assumptions


def digest(document: Mapping[str, Any]) -> str:
    """SHA-256 of a document, but for "digest" and "versions".

    It tells an altered copy from the original; it proves nothing by itself.
    """
    parts = {k: v for k, v in document.items() if k not in ("digest", "versions")}
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()


def versions() -> dict[str, str]:
    """Versions that a certificate records."""
    return {name: metadata.version(name) for name in ("rrnn_opt", "python-flint")}


Judge = Callable[[Any, Any, Any], Answer]


def _composite(graph: ClaimGraph, payload: Any, document: Any) -> Answer:
    return composite.judge(graph, payload, _part)


def _part(document: Mapping[str, Any]) -> Part:
    checked = check_certificate(document)
    return checked.status, checked.reason, checked.assumptions, checked.trust


METHODS: dict[str, Judge] = {
    "composite": _composite,
    "identity": identity.judge,
    "point": point.judge,
    "interval": interval.judge,
    "terms": terms.judge,
    "replay": replay.judge,
    "smt": smt.judge,
    "sos": sos.judge,
}
"""The methods for claims about a graph; each is the ``judge`` of its own module."""

FORMS: dict[str, tuple[Callable[[Any], Any], dict[str, Judge]]] = {
    "graph": (read_claim, METHODS),
    "decay": (
        lmi.read_decay,
        {"lmi": lmi.judge, "spectrum": lmi.judge_spectrum},
    ),
}
"""How claims are written down, and the methods for each form."""
