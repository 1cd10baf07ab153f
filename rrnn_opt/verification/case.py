"""A statement together with what tests the machine on it, and its printed row."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from rrnn_opt.arguments import checked
from rrnn_opt.claim import Claim
from rrnn_opt.decay import DecayClaim
from rrnn_opt.verification.certify import certify
from rrnn_opt.verification.composite import Proof, settle
from rrnn_opt.verification.document import Witness
from rrnn_opt.verification.verdict import Evidence, Status, Verdict

ESTABLISHED = (Status.PROVED, Status.HOLDS_UNDER)
Statement = Claim | DecayClaim | Proof
"""What can be settled."""
Place = Callable[[str, Mapping[str, Any]], str | None]
"""Writes a certificate under a name; returns its path, or None where that failed."""


@checked()
@dataclass(frozen=True, eq=False)
class Mutation:
    """A broken or mended variant of a statement, whose truth is known.

    A machine that proves a statement must fail on a false variant; one that
    refutes a statement must fail on a true variant.

    Attributes:
        text: what was changed.
        proof: the variant, as a claim or with its proof tree.
        holds: whether the variant is true.
    """

    text: str
    proof: Statement
    holds: bool = False

    def caught(self, verdict: Verdict) -> bool:
        """Whether a verdict of the variant does not contradict its truth."""
        if self.holds:
            return verdict.status != Status.REFUTED
        return verdict.status not in ESTABLISHED


@checked()
@dataclass(frozen=True, eq=False)
class Repair:
    """What is true in place of a statement.

    Attributes:
        proof: the mended statement, as a claim or with its proof tree.
        witnesses: points that may refute it, too.
    """

    proof: Statement
    witnesses: tuple[Witness, ...] = ()

    @property
    def claim(self) -> Claim | DecayClaim:
        """The mended statement."""
        return claim_of(self.proof)


@checked()
@dataclass(frozen=True, eq=False)
class ClaimCase:
    """A statement as it stands, and a variant that tests the machine.

    Nothing here says what the verdict should be.

    Attributes:
        proof: the statement, as a claim or with its proof tree.
        mutation: a variant that must not get the same verdict.
        witnesses: points that may refute the statement.
        repaired: what is true instead, or in a sharper form.
        example: a point that keeps the hypotheses, if the search finds none.
        evidence: what samples or tests say beside the verdict.
    """

    proof: Statement
    mutation: Mutation | None = None
    witnesses: tuple[Witness, ...] = ()
    repaired: Repair | None = None
    example: Witness | None = None
    evidence: tuple[Evidence, ...] = ()

    @property
    def claim(self) -> Claim | DecayClaim:
        """The statement."""
        return claim_of(self.proof)

    def settle(self, *, seed: int = 0) -> Settled:
        """Settle the statement, its mutation and its repaired form."""
        points = self.witnesses + (() if self.example is None else (self.example,))
        verdict = _settled(self.proof, points, seed)
        mutant = mended = None
        if self.repaired is not None:
            mended = _settled(self.repaired.proof, self.repaired.witnesses, seed)
        if self.mutation is not None:
            mutant = self._mutant(mended, seed)
        return Settled(self, verdict, mutant, mended)

    def _mutant(self, mended: Verdict | None, seed: int) -> Verdict | None:
        """The verdict of the mutation; a repaired statement may be it."""
        if self.mutation is None:
            return None
        if self.repaired is not None and self.mutation.proof is self.repaired.proof:
            return mended
        return settle(self.mutation.proof, seed=seed)


@dataclass(frozen=True, eq=False)
class Remark:
    """An entry that states nothing which could be true or false.

    Attributes:
        id: of the entry.
        source: where it stands.
        statement: in words.
        kind: "NO_PROPOSITION" or "EVIDENCE_ONLY".
        reason: why there is no verdict.
        evidence: samples and tests.
    """

    id: str
    source: str
    statement: str
    kind: str
    reason: str
    evidence: tuple[Evidence, ...] = ()

    def row(self) -> dict[str, Any]:
        """The row of ``rrnn verify --json``: nothing is known, and why."""
        names = ("dynamics", "jacobian", "witness", "engine", "trust", "certificate")
        empty: dict[str, Any] = dict.fromkeys(names)
        told = {"id": self.id, "source": self.source, "statement": self.statement}
        known = {"verdict": "UNKNOWN", "kind": self.kind, "reason": self.reason}
        return empty | told | known | {"assumptions": [], "mutation": "", "time_s": 0.0}


@dataclass(frozen=True, eq=False)
class Settled:
    """A case with its verdicts.

    Attributes:
        case: the case.
        verdict: of the statement.
        mutant: verdict of the mutation, or None.
        mended: verdict of the repaired statement, or None.
    """

    case: ClaimCase
    verdict: Verdict
    mutant: Verdict | None = None
    mended: Verdict | None = None

    @property
    def caught(self) -> bool:
        """Whether the verdict of the mutation agrees with its truth."""
        mutation = self.case.mutation
        if mutation is None or self.mutant is None:
            return True
        return mutation.caught(self.mutant)

    def row(self, *, place: Place | None = None) -> dict[str, Any]:
        """The row of ``rrnn verify --json``.

        Args:
            place: where certificates are written; nowhere by default.
        """
        mutation, text = self.case.mutation, ""
        if mutation is not None and self.mutant is not None:
            text = f"{mutation.text}: {self.mutant.status}"
        claim, certificate = self.case.claim, self.verdict.certificate
        path = place(claim.id, certificate) if place and certificate else None
        row = verdict_row(claim, self.verdict, text, certificate=path)
        row["kind"] = "PROPOSITION"
        if self.mended is not None and self.case.repaired is not None:
            mended = self.mended.certificate
            where = place(f"{claim.id}_repaired", mended) if place and mended else None
            row["repaired"] = {
                "statement": self.case.repaired.claim.statement,
                "verdict": str(self.mended.status),
                "assumptions": list(self.mended.assumptions),
                "engine": self.mended.engine,
                "trust": self.mended.trust,
                "reason": self.mended.reason,
                "certificate": where,
            }
        return row


def claim_of(statement: Statement) -> Claim | DecayClaim:
    """The claim, whether or not it comes with a proof tree."""
    return statement.claim if isinstance(statement, Proof) else statement


def _settled(
    statement: Statement, witnesses: tuple[Witness, ...], seed: int
) -> Verdict:
    if isinstance(statement, Proof):
        return settle(statement, seed=seed)
    return certify(statement, witnesses=witnesses, seed=seed)


def verdict_row(
    claim: Claim | DecayClaim,
    verdict: Verdict,
    mutation: str = "",
    *,
    certificate: str | None = None,
) -> dict[str, Any]:
    """One row of ``rrnn verify --json``.

    Args:
        claim: the statement.
        verdict: what is known of it.
        mutation: the broken variant and its verdict, in words.
        certificate: path of the certificate, where it was written.
    """
    return {
        "id": claim.id,
        "source": claim.source,
        "statement": claim.statement,
        "dynamics": claim.order,
        "jacobian": claim.jacobian,
        "verdict": str(verdict.status),
        "assumptions": list(verdict.assumptions),
        "witness": verdict.witness,
        "engine": verdict.engine,
        "trust": verdict.trust,
        "reason": verdict.reason,
        "mutation": mutation,
        "time_s": verdict.time_s,
        "certificate": certificate,
        "example": _example(verdict),
    }


def _example(verdict: Verdict) -> dict[str, list[str]] | None:
    """The point that shows that a proof is of something."""
    if verdict.certificate is None or verdict.status not in ESTABLISHED:
        return None
    example: dict[str, list[str]] | None = verdict.certificate["witness"]
    return example
