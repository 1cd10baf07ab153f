"""Engine "smt": z3 on the negation of a claim, cvc5 as second opinion.

Every query runs in a process of its own under a wall limit.  "unsat" is
proposed as a certificate that the checker repeats with a translation of its
own; a model is only a candidate that has to be replayed.
"""

from __future__ import annotations

import importlib.util
import json
import math
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

from rrnn_opt.claim import Claim
from rrnn_opt.errors import UndecidedError
from rrnn_opt.verification.document import certificate_document
from rrnn_opt.verification.engines.points.falsify import worth_replaying
from rrnn_opt.verification.engines.process import run_apart
from rrnn_opt.verification.engines.smt.text import SmtText, smt_text

WORKER = Path(__file__).with_name("worker.py")
GRACE_S = 2.0  # starting a solver, and stopping by itself
SECOND_S = 3.0  # wall time of the second opinion


def propose(claim: Claim, *, budget_s: float, seed: int) -> Iterator[dict[str, Any]]:
    """Ask z3; on unsat ask cvc5 too, where it is installed.

    Raises:
        UndecidedError: no translation, no answer in time, no solver, or two
            solvers that disagree.
    """
    query = smt_text(claim)
    answer = ask(query, "z3", budget_s)
    if answer.status == "sat":
        for point in candidates(claim, query, answer.model):
            if worth_replaying(claim, point):
                yield certificate_document(claim, "replay", witness=point)
        raise UndecidedError("z3 has a model, but it breaks nothing when replayed")
    if answer.status != "unsat":
        raise UndecidedError(f"z3: {answer.status}")
    agreed = ["z3"]
    if importlib.util.find_spec("cvc5") is not None:
        second = ask(query, "cvc5", min(SECOND_S, budget_s)).status
        if second == "sat":
            raise UndecidedError("z3 says unsat, cvc5 says sat: nothing is believed")
        agreed += ["cvc5"] if second == "unsat" else []
    yield certificate_document(claim, "smt", payload={"solvers": agreed})


@dataclass(frozen=True)
class SmtAnswer:
    """What a solver said.

    Attributes:
        status: "unsat", "sat", or why there is neither.
        model: numbers by SMT name, for "sat".
    """

    status: str
    model: dict[str, Fraction]


def ask(query: SmtText, solver: str, wall_s: float) -> SmtAnswer:
    """Run one solver in its own process and kill it at the wall limit."""
    pairs = [x for p in query.pairs.values() for x in p if x[0] in "sc"]
    job = {
        "solver": solver,
        "common": "\n".join(query.common),
        "negations": query.negations,
        "variables": [*query.names.values(), *pairs],
        "timeout_s": wall_s,
    }
    done = run_apart(WORKER, job, wall_s + GRACE_S)
    if done is None:
        return SmtAnswer(f"no answer in {wall_s:.3g} s", {})
    if done.returncode != 0:
        last = (done.stderr.strip().splitlines() or ["no message"])[-1]
        return SmtAnswer(f"stopped with status {done.returncode}: {last[:200]}", {})
    answer = json.loads(done.stdout)
    model = {name: Fraction(x) for name, x in answer["model"].items()}
    return SmtAnswer(answer["status"], model)


def candidates(
    claim: Claim, query: SmtText, model: dict[str, Fraction]
) -> Iterator[dict[str, list[Fraction]]]:
    """Points of a model; angles are read off their sine and cosine."""
    angles = _angles(query, model)
    for turns in (True, False):
        point = {}
        for i, symbol in enumerate(claim.variables):
            values = []
            for k in range(symbol.size):
                x = model[query.names[i, k]]
                if turns and (i, k) in angles:
                    x = _nearest(angles[i, k], x)
                values.append(x)
            point[symbol.name] = values
        yield point
        if not angles:
            return


def _angles(query: SmtText, model: dict[str, Fraction]) -> dict[tuple[int, int], float]:
    angles = {}
    for value, (sine, cosine) in query.pairs.items():
        slot = query.tape.instructions[value].slot
        if slot is not None:
            angles[slot] = math.atan2(model[sine], model[cosine])
    return angles


def _nearest(angle: float, x: Fraction) -> Fraction:
    """The angle plus the whole turns that bring it nearest to x."""
    turns = round((float(x) - angle) / (2 * math.pi))
    return Fraction(angle + 2 * math.pi * turns)
