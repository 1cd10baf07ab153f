"""Writing a claim down as plain data, for the checker."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from rrnn_opt.check.claims.certificate import KIND
from rrnn_opt.claim import Claim, Range
from rrnn_opt.decay import DecayClaim
from rrnn_opt.errors import RrnnError
from rrnn_opt.symbolic.tape import Instruction, Port, Tape

Witness = Mapping[str, Sequence[Fraction | int | float]]


def certificate_document(
    claim: Claim,
    method: str,
    *,
    payload: Any = None,
    witness: Witness | None = None,
) -> dict[str, Any]:
    """The document that asks the checker to settle a claim by one method.

    Args:
        claim: the claim.
        method: name of a method of :mod:`rrnn_opt.check.claims.certificate`.
        payload: what the method needs, as plain data.
        witness: numbers by variable, column by column; floats stand for the
            exact rational numbers that they are.  For "replay" the point that
            breaks the goal, else one that keeps domain and hypotheses.

    Raises:
        UnsupportedOperationError: the graph holds an unknown operation.
        RrnnError: a number of the witness is not finite.
    """
    exact = None if witness is None else exact_point(witness)
    return document_of(claim_block(claim), method, payload, exact)


def document_of(
    block: Mapping[str, Any], method: str, payload: Any, witness: Any
) -> dict[str, Any]:
    """A document for the checker, whatever the form of the claim."""
    return {
        "kind": KIND,
        "schema": 1,
        "claim": block,
        "method": method,
        "payload": payload,
        "witness": witness,
    }


def claim_block(claim: Claim) -> dict[str, Any]:
    """The claim as plain data."""
    tape = Tape.of(claim.function())
    return {
        **heading(claim),
        "inputs": [port_row(port) for port in tape.inputs],
        "outputs": [port_row(port) for port in tape.outputs],
        "tape": [step_row(step) for step in tape.instructions],
        "senses": [relation.sense for relation in claim.relations],
        "hypotheses": [
            [h.id, h.statement, h.relation is None, h.added] for h in claim.hypotheses
        ],
        "domain": [_range(interval) for interval in claim.domain],
    }


def heading(claim: Claim | DecayClaim) -> dict[str, Any]:
    """What claims of every form are told apart by."""
    return {
        "id": claim.id,
        "source": claim.source,
        "statement": claim.statement,
        "fingerprint": claim.fingerprint,
        "order": claim.order,
        "jacobian": claim.jacobian,
    }


def exact_point(point: Witness) -> dict[str, list[str]]:
    """A point as text, without rounding.

    Raises:
        RrnnError: a number is not finite.
    """
    try:
        return {name: [str(Fraction(x)) for x in point[name]] for name in point}
    except (ValueError, OverflowError) as error:
        raise RrnnError("witness: every number must be finite") from error


def port_row(port: Port) -> list[Any]:
    """A variable or a result as plain data."""
    return [port.name, list(port.shape)]


def step_row(step: Instruction) -> list[Any]:
    """One operation as plain data."""
    const = None if step.const is None else step.const.hex()
    slot = None if step.slot is None else list(step.slot)
    return [step.op, step.out, list(step.args), const, slot]


def _range(interval: Range) -> dict[str, Any]:
    def side(bounds: Sequence[Fraction | None]) -> list[str | None]:
        return [None if x is None else str(Fraction(x)) for x in bounds]

    lower, upper = side(interval.lower), side(interval.upper)
    return {"variable": interval.variable, "lower": lower, "upper": upper}
