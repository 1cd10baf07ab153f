"""Verdicts and evidence: two types, and no way from one to the other."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Any, Literal, final

from rrnn_opt.check.claims.certificate import CheckedCertificate
from rrnn_opt.errors import RrnnError


class Status(StrEnum):
    """All answers there are."""

    PROVED = "PROVED"
    REFUTED = "REFUTED"
    HOLDS_UNDER = "HOLDS_UNDER"
    UNKNOWN = "UNKNOWN"


@final
@dataclass(frozen=True)
class Verdict:
    """What is known about a claim.

    Anything but UNKNOWN rests on a certificate that the checker has judged,
    and says exactly what the checker said.

    Attributes:
        claim: fingerprint of the claim.
        engine: who found it: the name of an engine, "witness", "composite", or ""
            when nobody did.
        checked: the checker's answer; None for UNKNOWN.
        residue: what stood in the way of every engine, for UNKNOWN.
        time_s: wall time of engines and checker, s.

    Raises:
        RrnnError: the certificate is of another claim, settles nothing, or was
            not made by the checker.
    """

    claim: str
    engine: str = ""
    checked: CheckedCertificate | None = None
    residue: tuple[str, ...] = ()
    time_s: float = 0.0

    def __post_init__(self) -> None:
        """Hold the certificate against the claim."""
        if self.checked is None:
            return
        if not isinstance(self.checked, CheckedCertificate):
            raise RrnnError("verdict: only the checker's own answer can settle a claim")
        if not self.checked.holds:
            raise RrnnError(f"verdict: nothing is settled ({self.checked.reason})")
        if self.checked.fingerprint != self.claim:
            raise RrnnError("verdict: the certificate is that of another claim")

    @property
    def status(self) -> Status:
        """PROVED, REFUTED, HOLDS_UNDER or UNKNOWN."""
        return Status.UNKNOWN if self.checked is None else Status(self.checked.status)

    @property
    def reason(self) -> str:
        """Why, in half a sentence."""
        return "; ".join(self.residue) if self.checked is None else self.checked.reason

    @property
    def certificate(self) -> dict[str, Any] | None:
        """The document that anyone can check again."""
        return None if self.checked is None else self.checked.certificate

    @property
    def witness(self) -> dict[str, list[str]] | None:
        """The point that refutes the claim, as exact numbers."""
        return None if self.checked is None else self.checked.witness

    @property
    def assumptions(self) -> tuple[str, ...]:
        """What was assumed beyond the claim, for HOLDS_UNDER."""
        return () if self.checked is None else self.checked.assumptions

    @property
    def trust(self) -> str | None:
        """One of "exact", "arb", "interval", "smt", "pen": its weakest part's."""
        return None if self.checked is None else self.checked.trust


@final
@dataclass(frozen=True)
class Evidence:
    """What samples or a statistical test suggest; never a verdict.

    Attributes:
        claim: id of the claim.
        kind: "sampled" or "statistical".
        n: number of samples.
        interval: confidence interval, or least and largest value seen.
        seed: of the generator.
    """

    claim: str
    kind: Literal["sampled", "statistical"]
    n: int
    interval: tuple[float, float]
    seed: int

    def to_dict(self) -> dict[str, Any]:
        """The row of a report."""
        return {
            "claim": self.claim,
            "kind": self.kind,
            "n": self.n,
            "interval": list(self.interval),
            "seed": self.seed,
        }
