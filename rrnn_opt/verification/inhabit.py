"""A point of the domain that keeps a claim's hypotheses.

A proof is worth nothing where no such point exists; certificates carry one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rrnn_opt.check.claim_document import ClaimGraph, read_claim
from rrnn_opt.check.claim_replay import require_admitted
from rrnn_opt.claim import Claim
from rrnn_opt.errors import UndecidedError
from rrnn_opt.verification.document import Witness, claim_block, exact_point
from rrnn_opt.verification.falsify import keepers

Exact = dict[str, list[str]]


def inhabitant(claim: Claim, witnesses: Sequence[Witness], seed: int) -> Exact | None:
    """A point that is certain to keep domain and hypotheses, or None.

    Args:
        claim: the claim.
        witnesses: points to try first.
        seed: of the search.
    """
    graph = read_claim(claim_block(claim))
    for point in _candidates(claim, witnesses, seed):
        if _keeps(graph, point):
            return point
    return None


def _candidates(
    claim: Claim, witnesses: Sequence[Witness], seed: int
) -> Iterator[Exact]:
    for given in witnesses:
        yield exact_point(given)
    for found in keepers(claim, seed=seed):
        yield exact_point(found)


def _keeps(graph: ClaimGraph, point: Exact) -> bool:
    try:
        require_admitted(graph, point)
    except UndecidedError:
        return False
    return True
