"""One point through every solver and network, and what that adds to the tallies."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from rrnn_opt.dynamics import Dynamics
from rrnn_opt.solving import Duals, Instance, Qpsolvers
from rrnn_opt.solving.parts import Dense
from rrnn_opt.solving.settle import settle_at
from rrnn_opt.validation.studies.agreement import (
    TOLERANCE,
    Answer,
    Conditioning,
    answer_of,
    conditioning,
    dual_distance,
    is_right,
    primal_distance,
    truth,
)
from rrnn_opt.validation.studies.points import Point
from rrnn_opt.validation.studies.tally import (
    EXAMPLES,
    AnswerTally,
    PointTally,
    plain,
)

SETTLED = 1e-10
"""KKT residual that a network is asked for."""


@dataclass(frozen=True, eq=False)
class Reply:
    """What one participant gave.

    Attributes:
        answer: None where our check passed none.
        status: our judgement, its key.
        newton: whether Newton steps finished it.
    """

    answer: Answer | None
    status: str
    newton: bool = False


@dataclass
class Block:
    """The tallies of one case.

    Attributes:
        solvers: of qpsolvers, by name.
        networks: by name.
        points: tally of the points.
        tallies: of solvers and networks.
    """

    solvers: Mapping[str, Qpsolvers]
    networks: Mapping[str, Dynamics]
    points: PointTally = field(default_factory=PointTally)
    tallies: dict[str, AnswerTally] = field(default_factory=dict)

    def add(self, key: str, point: Point) -> None:
        """Solve a point in every way, and count.

        Args:
            key: of the point, for the examples.
            point: parameters and programme.
        """
        qp = Dense.of(point.problem)
        replies = {name: _asked(s, qp, point) for name, s in self.solvers.items()}
        replies |= {name: _settled(n, qp, point) for name, n in self.networks.items()}
        answers = [r.answer for r in replies.values() if r.answer is not None]
        best = min(answers, key=lambda a: a.residual, default=None)
        self.points.n += 1
        self.points.bound += point.bound
        self.points.contact += point.contact
        if best is None:
            known, exact = Conditioning(float("inf"), False, False), None
        else:
            known, exact = conditioning(qp, best.x), truth(qp, answers)
        self.points.well += known.primal
        self.points.well_dual += known.dual
        self.points.proved += known.primal and exact not in (None, *answers)
        self._count(key, replies, known, exact)

    def _count(
        self,
        key: str,
        replies: Mapping[str, Reply],
        known: Conditioning,
        exact: Answer | None,
    ) -> None:
        right = {
            name: r.answer is not None and is_right(r.answer, exact, known)
            for name, r in replies.items()
        }
        for name, reply in replies.items():
            tally = self.tallies.setdefault(name, AnswerTally())
            _one(tally, reply, right=right[name], key=key)
            tally.missed += known.primal and reply.answer is None
            if reply.answer is None or not known.primal:
                continue
            if exact is not None:
                _off(tally, reply.answer, exact, dual=known.dual)
            for other in self.solvers:
                reference = replies[other].answer
                if other != name and reference is not None:
                    pair = (reply.answer, reference)
                    _apart(tally, other, pair, right[other], dual=known.dual)

    def row(self) -> dict[str, Any]:
        """All tallies as data."""
        return {
            "points": plain(self.points),
            "solvers": {n: plain(self._of(n)) for n in self.solvers},
            "networks": {n: plain(self._of(n)) for n in self.networks},
        }

    def _of(self, name: str) -> AnswerTally:
        return self.tallies.get(name, AnswerTally())


def _one(tally: AnswerTally, reply: Reply, *, right: bool, key: str) -> None:
    """Count one reply by itself."""
    tally.n += 1
    if not right:
        tally.statuses[reply.status] = tally.statuses.get(reply.status, 0) + 1
        tally.examples += [key] if len(tally.examples) < EXAMPLES else []
    if reply.answer is None:
        return
    tally.answered += 1
    tally.right += right
    tally.wrong += not right
    tally.newton += reply.newton
    tally.residual = max(tally.residual, reply.answer.residual)


def _off(tally: AnswerTally, answer: Answer, exact: Answer, *, dual: bool) -> None:
    """Count how far an answer is from the truth."""
    tally.truth_primal = max(tally.truth_primal, primal_distance(answer, exact))
    if dual:
        tally.truth_dual = max(tally.truth_dual, dual_distance(answer, exact))


def _apart(
    tally: AnswerTally,
    other: str,
    pair: tuple[Answer, Answer],
    reference_right: bool,
    *,
    dual: bool,
) -> None:
    """Count how far an answer is from a solver's, at a well-conditioned point."""
    primal = primal_distance(*pair)
    multipliers = dual_distance(*pair) if dual else 0.0
    if max(primal, multipliers) > TOLERANCE:
        tally.apart[other] = tally.apart.get(other, 0) + 1
    if reference_right:
        tally.primal = max(tally.primal, primal)
        tally.dual = max(tally.dual, multipliers)


def _asked(solver: Qpsolvers, qp: Dense, point: Point) -> Reply:
    solver.setup(Instance(point.problem))
    solution = solver.solve()
    if solution.x is None or solution.duals is None:
        return Reply(None, solution.status.key)
    return Reply(answer_of(qp, solution.x, solution.duals), solution.status.key)


def _settled(network: Dynamics, qp: Dense, point: Point) -> Reply:
    x, info = settle_at(network, point.parameters, tolerance=SETTLED)
    if x is None:
        return Reply(None, info.status.key)
    duals = info.duals
    signed = Duals(-duals["equality"], duals["inequality"], duals["box"])
    return Reply(answer_of(qp, x, signed), info.status.key, info.newton > 0)
