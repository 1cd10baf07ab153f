"""What a block of points adds up to; two tallies add up to one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields
from typing import Any


@dataclass
class PointTally:
    """Of the points of one scheme on one robot.

    Attributes:
        n: points.
        none: draws that gave no feasible point.
        bound: points with an active bound.
        contact: points where an obstacle acts.
        well: points whose active rows fix x well.
        well_dual: points whose active rows fix the multipliers too.
        proved: well points whose optimum was found by a linear solve as well.
    """

    n: int = 0
    none: int = 0
    bound: int = 0
    contact: int = 0
    well: int = 0
    well_dual: int = 0
    proved: int = 0


@dataclass
class AnswerTally:
    """Of one network or solver on one scheme and robot.

    Attributes:
        n: points that it was asked.
        answered: points where it gave a point that passed our KKT check.
        right: answers that are right.
        wrong: answers that are not.
        missed: well points where it gave no answer.
        newton: answers finished by Newton steps.
        residual: worst KKT residual of an answer.
        primal: worst difference in x to a right answer of a solver, well points.
        dual: the same of the multipliers, relative to 1 + the largest.
        truth_primal: worst difference in x to the truth, well points.
        truth_dual: the same of the multipliers.
        statuses: our judgement of what is not right, no answer included, counted;
            "solved" is never expected here.
        apart: well points where it is more than the tolerance from a solver,
            by that solver's name.
        examples: keys of the first points without a right answer.
    """

    n: int = 0
    answered: int = 0
    right: int = 0
    wrong: int = 0
    missed: int = 0
    newton: int = 0
    residual: float = 0.0
    primal: float = 0.0
    dual: float = 0.0
    truth_primal: float = 0.0
    truth_dual: float = 0.0
    statuses: dict[str, int] = field(default_factory=dict)
    apart: dict[str, int] = field(default_factory=dict)
    examples: list[str] = field(default_factory=list)


Tally = PointTally | AnswerTally

EXAMPLES = 3
"""So many keys are kept of points without a right answer."""

_LARGEST = ("residual", "primal", "dual", "truth_primal", "truth_dual")


def add(total: Tally, part: Mapping[str, Any]) -> None:
    """Add a tally, given as a mapping, to another of its kind.

    Args:
        total: changed.
        part: what ``asdict`` makes of a tally.
    """
    for name in (f.name for f in fields(total)):
        have, more = getattr(total, name), part[name]
        if isinstance(have, dict):
            for key, count in more.items():
                have[key] = have.get(key, 0) + count
        elif isinstance(have, list):
            have.extend(more[: EXAMPLES - len(have)])
        elif name in _LARGEST:
            setattr(total, name, max(have, more))
        else:
            setattr(total, name, have + more)


def plain(tally: Tally) -> dict[str, Any]:
    """The tally as data for a row of a study."""
    return asdict(tally)
