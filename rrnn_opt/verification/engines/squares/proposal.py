"""One certificate of all elements of a goal, whatever finds its identities."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from typing import Any

from rrnn_opt.check.claims.document import read_claim
from rrnn_opt.check.claims.graph.expansion import Polynomial
from rrnn_opt.check.claims.graph.semialgebraic import Semialgebraic, semialgebraic
from rrnn_opt.claim import Claim
from rrnn_opt.errors import UndecidedError
from rrnn_opt.verification.document import certificate_document, claim_block

Prove = Callable[[Semialgebraic, Polynomial, float], dict[str, Any] | None]
"""Setting, goal and end of the time allowed -> an identity, or None."""


def element_by_element(
    claim: Claim, prove: Prove, *, what: str, budget_s: float
) -> Iterator[dict[str, Any]]:
    """A certificate for the checker's method "sos".

    Args:
        claim: what is to be shown.
        prove: finds the identity of one element.
        what: identities of what, for the reader.
        budget_s: time allowed, s.

    Raises:
        UndecidedError: an element has no identity of this form.
    """
    end = time.monotonic() + budget_s
    setting = semialgebraic(read_claim(claim_block(claim)))
    elements = []
    for k, goal in enumerate(setting.goals):
        proof = prove(setting, goal, end)
        if proof is None:
            raise UndecidedError(f"no identity of {what} for element {k}")
        elements.append(proof)
    yield certificate_document(claim, "sos", payload={"elements": elements})
