"""Engines whose whole work is the checker's: identity, signs of terms, one point."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from rrnn_opt.claim import Claim
from rrnn_opt.verification.document import certificate_document


def propose_identity(
    claim: Claim, *, budget_s: float, seed: int
) -> Iterator[dict[str, Any]]:
    """The goal may be 0 identically; the checker expands it."""
    yield certificate_document(claim, "identity")


def propose_terms(
    claim: Claim, *, budget_s: float, seed: int
) -> Iterator[dict[str, Any]]:
    """Every term of an inequality may have the claimed sign."""
    if claim.goal.sense != "==0":
        yield certificate_document(claim, "terms")


def propose_point(
    claim: Claim, *, budget_s: float, seed: int
) -> Iterator[dict[str, Any]]:
    """The domain may be a single point, where the checker can compute."""
    known = {r.variable for r in claim.domain if None not in r.lower}
    pinned = all(r.lower == r.upper for r in claim.domain)
    if pinned and known == {s.name for s in claim.variables}:
        yield certificate_document(claim, "point")
