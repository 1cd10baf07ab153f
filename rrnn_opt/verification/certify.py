"""Settling a claim: engines propose, the checker decides."""

from __future__ import annotations

import itertools
import time
from collections.abc import Iterator, Sequence
from typing import Any

from rrnn_opt.check.claim_certificate import UNKNOWN, check_certificate
from rrnn_opt.claim import Claim
from rrnn_opt.errors import RrnnError, UnsupportedOperationError
from rrnn_opt.verification.document import Witness, certificate_document
from rrnn_opt.verification.falsify import candidates
from rrnn_opt.verification.verdict import Verdict

Proposal = tuple[str, dict[str, Any]]


def certify(
    claim: Claim, *, witnesses: Sequence[Witness] = (), seed: int = 0
) -> Verdict:
    """Prove a claim, refute it, or say why neither was possible.

    The claim speaks of its expression graph, over the real numbers: doubles
    are the rationals that they are, and what CasADi simplified while the graph
    was built (``x / x`` to 1) is not part of it.

    The engines, in order: exact identity, signs of terms, the given witnesses,
    and a seeded search for a witness.  Each only proposes a certificate; the
    verdict is the independent checker's.

    Args:
        claim: what to settle.
        witnesses: points that may refute it: numbers by variable, column by
            column; floats stand for the exact rational numbers that they are.
        seed: of the search.

    Returns:
        The verdict.  UNKNOWN lists in ``residue`` what stopped each engine.

    Raises:
        RrnnError: a witness lacks a variable, or holds a number that is not
            finite.
    """
    begin = time.perf_counter()
    fingerprint = ""
    residue: dict[str, str] = {}
    try:
        fingerprint = claim.fingerprint
        for engine, document in _proposals(claim, witnesses, seed):
            checked = check_certificate(document)
            if checked.status != UNKNOWN:
                elapsed = time.perf_counter() - begin
                return Verdict(fingerprint, engine, checked, (), elapsed)
            residue.setdefault(engine, checked.reason)
    except UnsupportedOperationError as error:
        residue["tape"] = str(error)
    residue.setdefault("falsifier", "no point found that breaks the goal")
    reasons = tuple(f"{engine}: {reason}" for engine, reason in residue.items())
    elapsed = time.perf_counter() - begin
    return Verdict(fingerprint, residue=reasons, time_s=elapsed)


def _proposals(
    claim: Claim, witnesses: Sequence[Witness], seed: int
) -> Iterator[Proposal]:
    equation = claim.goal.sense == "==0"
    for method in ("identity",) if equation else ("identity", "terms"):
        yield method, certificate_document(claim, method)
    names = {symbol.name for symbol in claim.variables}
    for point in witnesses:
        if set(point) != names:
            raise RrnnError(f"{claim.id}: a witness names {', '.join(sorted(names))}")
        yield "witness", certificate_document(claim, "replay", witness=point)
    if all(h.relation is not None for h in claim.hypotheses):
        for point in itertools.islice(candidates(claim, seed=seed), 64):
            yield "falsifier", certificate_document(claim, "replay", witness=point)
