"""A point of the domain that keeps a claim's hypotheses.

A proof is worth nothing where no such point exists; certificates carry one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rrnn_opt.check.claims.document import ClaimGraph, read_claim
from rrnn_opt.check.claims.methods.replay import require_admitted
from rrnn_opt.claim import Claim
from rrnn_opt.errors import UndecidedError
from rrnn_opt.verification.document import Witness, claim_block, exact_point
from rrnn_opt.verification.engines.points.falsify import keepers
from rrnn_opt.verification.engines.smt import engine as smt
from rrnn_opt.verification.engines.smt.text import smt_text

Exact = dict[str, list[str]]
SOLVER_S = 5.0
"""Wall time of z3 for a point that sampling did not find, s."""


def inhabitant(claim: Claim, witnesses: Sequence[Witness], seed: int) -> Exact:
    """A point that is certain to keep domain and hypotheses.

    Args:
        claim: the claim.
        witnesses: points to try first.
        seed: of the search.

    Raises:
        UndecidedError: none was found; the hypotheses may contradict each other.
    """
    graph = read_claim(claim_block(claim))
    for point in _candidates(claim, witnesses, seed):
        if _keeps(graph, point):
            return point
    raise UndecidedError("no point was found that keeps the hypotheses")


def _candidates(
    claim: Claim, witnesses: Sequence[Witness], seed: int
) -> Iterator[Exact]:
    for given in witnesses:
        yield exact_point(given)
    for found in keepers(claim, seed=seed):
        yield exact_point(found)
    try:
        query = smt_text(claim)
    except UndecidedError as error:
        reason = f"no point was found that keeps the hypotheses ({error.reason})"
        raise UndecidedError(reason) from error
    query.negations = ["true"]  # whatever becomes of the goal
    answer = smt.ask(query, "z3", SOLVER_S)
    if answer.status == "unsat":
        raise UndecidedError(
            "the hypotheses contradict each other, or leave the goal undefined, says z3"
        )
    if answer.status == "sat":
        for modelled in smt.candidates(claim, query, answer.model):
            yield exact_point(modelled)


def _keeps(graph: ClaimGraph, point: Exact) -> bool:
    try:
        require_admitted(graph, point)
    except UndecidedError:
        return False
    return True
