"""Proofs made of proofs: lemmas, instances of them, and named rules.

A composite certificate has ``"method": "composite"`` and the payload::

    {"parts": [certificates, each judged again here],
     "rules": ["pen: ...", ...],      steps that nothing checks: assumptions
     "combination": null or
        {"inputs", "outputs", "tape": expressions over the claim's variables,
         "elements": [[term, ...], ...]}}    one list for each goal element

The claim is established either by a part that has its fingerprint, or by a
combination: every element of the goal is a sum of terms, plus what is seen to
have the claimed sign term by term (nothing, for an equation).  The terms::

    {"use": "lemma", "part": k, "element": j, "arguments": [ref, ...],
     "factor": ref}          factor * goal_j of part k, at these arguments
    {"use": "hypothesis", "output": i, "element": j, "factor": ref}
    {"use": "square", "of": ref, "factor": ref}

A ref is the number of an expression.  Factors are never negative, seen term by
term, unless what they multiply is an equation.  The hypotheses and the domain
of a lemma must hold at its arguments: each is seen term by term, or exceeds a
hypothesis of the claim by what is.  An operation that is not defined everywhere
(1/x) may occur in lemmas and expressions only where the claim has it itself.

Assumptions of all parts and the rules are united, and the weakest trust wins.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from rrnn_opt.check.claims.answer import Answer, undefined, weakest
from rrnn_opt.check.claims.document import WHERE, ClaimGraph, read_claim
from rrnn_opt.check.claims.methods.combination import Lemma, combine
from rrnn_opt.errors import DocumentError, UndecidedError

MAX_PARTS = 32
Part = tuple[str, str, tuple[str, ...], str]
"""Status, reason, assumptions and trust of a part."""
Judge = Callable[[Mapping[str, Any]], Part]


def judge(graph: ClaimGraph, payload: Mapping[str, Any], judged: Judge) -> Answer:
    """Find a composite proof again.

    Args:
        graph: the claim.
        payload: see the module.
        judged: the checker of one certificate, for the parts.

    Raises:
        UndecidedError: the parts do not make a proof of the claim.
        DocumentError: the payload is not readable.
    """
    try:
        lemmas = _lemmas(payload["parts"], judged)
        rules = tuple(str(rule) for rule in payload["rules"])
        partial, reason = _established(graph, payload["combination"], lemmas)
    except (KeyError, TypeError, ValueError, IndexError) as error:
        raise DocumentError(WHERE, f"proof not readable ({error!r})") from error
    if not all(rule.startswith("pen: ") for rule in rules):
        raise DocumentError(WHERE, "a rule that is not checked begins with 'pen: '")
    united = [*(a for part in lemmas for a in part.assumptions), *undefined(partial)]
    fresh = [a for a in dict.fromkeys([*united, *rules]) if a not in graph.added]
    trust = weakest("pen" if rules else "exact", *(part.trust for part in lemmas))
    return Answer("PROVED", reason, trust, tuple(fresh))


def _established(
    graph: ClaimGraph, combination: Any, lemmas: Sequence[Lemma]
) -> tuple[tuple[str, ...], str]:
    """Operations that may be undefined, and how the claim follows."""
    if combination is not None:
        reason = f"a combination of {len(lemmas)} lemmas and the hypotheses"
        return combine(graph, combination, lemmas), reason
    if all(part.graph.fingerprint != graph.fingerprint for part in lemmas):
        raise UndecidedError("no part is a proof of the claim")
    return (), f"proved as one of {len(lemmas)} parts"


def _lemmas(documents: Sequence[Mapping[str, Any]], judged: Judge) -> tuple[Lemma, ...]:
    """Judge every part."""
    if len(documents) > MAX_PARTS:
        raise UndecidedError(f"at most {MAX_PARTS} parts are judged")
    lemmas = []
    for document in documents:
        block = document["claim"]
        status, reason, assumptions, trust = judged(document)
        if status not in ("PROVED", "HOLDS_UNDER"):
            raise UndecidedError(f"part '{block.get('id')}' is {status}: {reason}")
        lemmas.append(Lemma(read_claim(block), assumptions, trust))
    return tuple(lemmas)
