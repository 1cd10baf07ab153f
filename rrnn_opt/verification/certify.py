"""Settling a claim: engines propose, the checker decides."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from rrnn_opt.arguments import checked
from rrnn_opt.check.claims.answer import UNKNOWN
from rrnn_opt.check.claims.certificate import CheckedCertificate, check_certificate
from rrnn_opt.claim import Claim
from rrnn_opt.decay import DecayClaim
from rrnn_opt.errors import (
    CompilerError,
    RrnnError,
    UndecidedError,
    UnsupportedOperationError,
)
from rrnn_opt.verification.document import Witness, certificate_document
from rrnn_opt.verification.engines import lmi, normal
from rrnn_opt.verification.engines.interval import engine as interval
from rrnn_opt.verification.engines.points import falsify
from rrnn_opt.verification.engines.points.inhabit import inhabitant
from rrnn_opt.verification.engines.protocol import Engine
from rrnn_opt.verification.engines.smt import engine as smt
from rrnn_opt.verification.engines.squares import products, sos
from rrnn_opt.verification.verdict import Verdict

ENGINES: tuple[Engine, ...] = (
    Engine("identity", normal.propose_identity),
    Engine("terms", normal.propose_terms),
    Engine("point", normal.propose_point),
    Engine("falsifier", falsify.propose),
    Engine("products", products.propose),
    Engine("smt", smt.propose),
    Engine("interval", interval.propose),
    Engine("sos", sos.propose),
    Engine("lmi", lmi.propose, DecayClaim),
)
"""All engines, in the order in which they are tried."""

BUDGET_S = 60.0
"""Default wall time of all engines together, s."""


@checked(skip=["witnesses"])
def certify(
    claim: Claim | DecayClaim,
    *,
    witnesses: Sequence[Witness] = (),
    engines: Sequence[str] | None = None,
    budget_s: float = BUDGET_S,
    seed: int = 0,
) -> Verdict:
    """Prove a claim, refute it, or say why neither was possible.

    The claim speaks of its expression graph, over the real numbers: doubles
    are the rationals that they are, and what CasADi simplified while the graph
    was built (``x / x`` to 1) is not part of it.

    The given witnesses come first, then the engines in the order of
    :data:`ENGINES`.  Each only proposes a certificate; the verdict is the
    independent checker's.  A proof also needs a point that keeps domain and
    hypotheses: one of the given witnesses, or one that is searched for.

    Args:
        claim: what to settle.
        witnesses: points that may refute it, or show that its hypotheses can
            be kept: numbers by variable, column by column; floats stand for
            the exact rational numbers that they are.
        engines: names of the engines to try; None for all.
        budget_s: wall time of all engines together, s; each gets an equal
            share of what is left, and may overrun it by one step.
        seed: of every search.

    Returns:
        The verdict.  UNKNOWN lists in ``residue`` what stopped each engine.

    Raises:
        RrnnError: an engine is not known, a witness lacks a variable, or gives
            it what is no list of its size of finite numbers.
    """
    begin = time.perf_counter()
    chosen = _chosen(engines, claim)
    for point in witnesses:
        _require_point(claim, point)
    fingerprint = ""
    residue: dict[str, str] = {}
    try:
        fingerprint = claim.fingerprint
        for engine, checked in _answers(claim, witnesses, chosen, budget_s, seed):
            if isinstance(checked, str):
                residue.setdefault(engine, checked)
            elif checked.status != UNKNOWN:
                elapsed = time.perf_counter() - begin
                return Verdict(fingerprint, engine, checked, (), elapsed)
            else:
                residue.setdefault(engine, checked.reason)
    except UnsupportedOperationError as error:
        residue["tape"] = str(error)
    reasons = tuple(f"{engine}: {reason}" for engine, reason in residue.items())
    elapsed = time.perf_counter() - begin
    return Verdict(fingerprint, residue=reasons, time_s=elapsed)


def _chosen(
    names: Sequence[str] | None, claim: Claim | DecayClaim
) -> tuple[Engine, ...]:
    known = {engine.name: engine for engine in ENGINES}
    for name in names or ():
        if name not in known:
            raise RrnnError(f"engine '{name}': use one of {', '.join(known)}")
    fit = [e for e in ENGINES if isinstance(claim, e.speaks_of)]
    return tuple(e for e in fit if names is None or e.name in names)


def _require_point(claim: Claim | DecayClaim, point: Witness) -> None:
    if isinstance(claim, DecayClaim):
        raise RrnnError(f"{claim.id}: a claim of decay takes no witnesses")
    names = {symbol.name for symbol in claim.variables}
    if not isinstance(point, Mapping) or set(point) != names:
        raise RrnnError(f"{claim.id}: a witness names {', '.join(sorted(names))}")
    for symbol in claim.variables:
        if np.shape(np.array(point[symbol.name], object)) != (symbol.size,):
            want = f"{symbol.size} numbers, column by column"
            raise RrnnError(f"{claim.id}: a witness gives '{symbol.name}' {want}")


def _answers(
    claim: Any,
    witnesses: Sequence[Witness],
    engines: Sequence[Engine],
    budget_s: float,
    seed: int,
) -> Iterator[tuple[str, CheckedCertificate | str]]:
    """What the checker says of every proposal, or why there is none."""
    for point in witnesses:
        document = certificate_document(claim, "replay", witness=point)
        yield "witness", check_certificate(document)
    end = time.monotonic() + budget_s
    inhabited = _Inhabited(claim, witnesses, seed)
    for k, engine in enumerate(engines):
        share = max(0.0, end - time.monotonic()) / (len(engines) - k)
        try:
            for document in engine.propose(claim, budget_s=share, seed=seed):
                yield engine.name, check_certificate(inhabited.completed(document))
        except _EmptyError as error:
            yield "hypotheses", str(error)
            return
        except UndecidedError as error:
            yield engine.name, error.reason
        except (UnsupportedOperationError, CompilerError) as error:
            yield engine.name, str(error)


class _Inhabited:
    """Adds to proofs a point that keeps the hypotheses, searched for once."""

    def __init__(self, claim: Any, witnesses: Sequence[Witness], seed: int) -> None:
        self._search = (claim, witnesses, seed)
        self._known: dict[str, list[str]] | None = None

    def completed(self, document: dict[str, Any]) -> dict[str, Any]:
        """The document with a witness.

        Raises:
            _EmptyError: there is none, so that nothing can be settled.
        """
        if document["witness"] is not None or "tape" not in document["claim"]:
            return document
        if self._known is None:
            try:
                self._known = inhabitant(*self._search)
            except UndecidedError as error:
                raise _EmptyError(error.reason) from error
        return document | {"witness": self._known}


class _EmptyError(Exception):
    """No point keeps the hypotheses, as far as is known."""
