"""A claim together with what tests the machine on it, and its printed row."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from rrnn_opt.claim import Claim
from rrnn_opt.verification.certify import certify
from rrnn_opt.verification.document import Witness
from rrnn_opt.verification.verdict import Mutation, Status, Verdict


@dataclass(frozen=True, eq=False)
class ClaimCase:
    """A claim, the verdict expected of it, and a variant that tests the machine.

    Attributes:
        claim: the statement.
        expected: what the verdict should be.
        mutation: a variant that must not get the same verdict.
        witnesses: points that may refute the claim.
    """

    claim: Claim
    expected: Status
    mutation: Mutation | None = None
    witnesses: tuple[Witness, ...] = ()

    def settle(self, *, seed: int = 0) -> Settled:
        """Certify the claim and its mutation."""
        verdict = certify(self.claim, witnesses=self.witnesses, seed=seed)
        if self.mutation is None:
            return Settled(self, verdict, None)
        return Settled(self, verdict, certify(self.mutation.claim, seed=seed))


@dataclass(frozen=True, eq=False)
class Settled:
    """A case with its verdicts.

    Attributes:
        case: the case.
        verdict: of the claim.
        mutant: verdict of the mutation, or None.
    """

    case: ClaimCase
    verdict: Verdict
    mutant: Verdict | None

    @property
    def as_expected(self) -> bool:
        """Whether the verdict is the expected one and the mutation was caught."""
        mutation = self.case.mutation
        caught = (
            mutation is None
            or self.mutant is None
            or self.mutant.status != mutation.never
        )
        return caught and self.verdict.status == self.case.expected

    def row(self, *, certificate: str | None = None) -> dict[str, Any]:
        """The row of ``rrnn verify --json``."""
        mutation, text = self.case.mutation, ""
        if mutation is not None and self.mutant is not None:
            text = f"{mutation.text}: {self.mutant.status}"
        claim = self.case.claim
        return verdict_row(claim, self.verdict, text, certificate=certificate)


def verdict_row(
    claim: Claim,
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
    }
