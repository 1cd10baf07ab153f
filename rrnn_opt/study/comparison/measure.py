"""The comparison as a study: a case is one solver in one mode on one set."""

from __future__ import annotations

import gc
import hashlib
import math
import os
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from rrnn_opt.solving import Instance, Solution, Solver, Status
from rrnn_opt.solving.residual import NOT_JUDGED
from rrnn_opt.study.cases import Case
from rrnn_opt.study.comparison.catalogue import problem_set
from rrnn_opt.study.comparison.entrants import Entrant
from rrnn_opt.study.comparison.problem_set import ProblemSet

PASSES = 5
BUDGET_S = 20.0
"""Seconds after which no further pass over a set is begun."""


@dataclass(frozen=True)
class Comparison:
    """Solvers on problem sets.

    Attributes:
        sets: names of sets, those of ``own`` among them.
        solvers: the entrants.
        own: sets of the user, by name.
        passes: over each set; the first call comes before them.
    """

    sets: tuple[str, ...]
    solvers: tuple[Entrant, ...]
    own: Mapping[str, ProblemSet] = field(default_factory=dict)
    passes: int = PASSES
    name: str = "comparison"

    def __iter__(self) -> Iterator[Case]:
        """Set by set, so that a worker makes each set once."""
        for name in self.sets:
            problems = self.problems(name)
            for entrant in self.solvers:
                for mode in entrant.modes_for(problems):
                    yield Case(
                        f"{name}/{entrant.name}/{mode}",
                        {
                            "stream": name,
                            "solver": entrant.name,
                            "mode": mode,
                            "version": entrant.version(),
                            "passes": self.passes,
                            "data": _digest(problems) if name in self.own else "",
                        },
                    )

    def problems(self, name: str) -> ProblemSet:
        """A set by its name."""
        return self.own[name] if name in self.own else problem_set(name)

    def measure(self, case: Case, rng: np.random.Generator) -> Mapping[str, Any]:
        """Judgements, residuals and times of every problem of the set."""
        given = case.parameters
        problems = self.problems(given["stream"])
        (entrant,) = (e for e in self.solvers if e.name == given["solver"])
        return {
            "stream": given["stream"],
            "solver": given["solver"],
            "mode": given["mode"],
            **measured_set(entrant, given["mode"], problems, passes=self.passes),
        }


def measured_set(
    entrant: Entrant, mode: str, problems: ProblemSet, *, passes: int = PASSES
) -> dict[str, Any]:
    """One solver in one mode on one set.

    Args:
        entrant: the solver.
        mode: one of its modes.
        problems: the set.
        passes: over the set, at most; fewer where they would take too long.

    Returns:
        Columns for a row: lists with one entry a problem, judged in the first
        pass; ``times_us`` has one list a pass.
    """
    began = time.perf_counter()
    answers: list[Solution] = []
    times: list[list[float]] = []
    with _silenced():
        solver = entrant.make(mode, problems)
        first = _pass(solver, problems, count=1)[0]
        for _ in range(passes):
            found = _pass(entrant.make(mode, problems), problems)
            answers = answers or found
            times.append([1e6 * answer.time_s for answer in found])
            if time.perf_counter() - began > BUDGET_S:
                break
    return {
        "first_us": 1e6 * first.time_s,
        "times_us": times,
        "inner_us": [_scaled(a.inner_s, 1e6) for a in answers],
        "truth": list(problems.truth),
        "status": [a.status.key for a in answers],
        "claims": [a.claims for a in answers],
        "handed": [a.handed for a in answers],
        "iterations": [a.iterations for a in answers],
        **_residuals(answers),
        "message": next((a.message for a in answers if a.message), "")[:300],
    }


@contextmanager
def _silenced() -> Iterator[None]:
    """What solvers print goes nowhere: some do so on every call."""
    kept = [os.dup(number) for number in (1, 2)]
    nowhere = os.open(os.devnull, os.O_WRONLY)
    try:
        for number in (1, 2):
            os.dup2(nowhere, number)
        yield
    finally:
        for number, handle in zip((1, 2), kept, strict=True):
            os.dup2(handle, number)
            os.close(handle)
        os.close(nowhere)


def _pass(
    solver: Solver, problems: ProblemSet, *, count: int | None = None
) -> list[Solution]:
    """Every problem once, in order; garbage is not collected in between."""
    answers = []
    gc.collect()
    gc.disable()
    try:
        for k, instance in enumerate(problems.instances[:count]):
            fresh = k == 0 or not problems.sequence
            answers.append(_asked(solver, instance, fresh=fresh))
    finally:
        gc.enable()
    return answers


def _asked(solver: Solver, instance: Instance, *, fresh: bool) -> Solution:
    """One answer; what a solver raises is an answer too."""
    began = time.perf_counter()
    try:
        (solver.setup if fresh else solver.update)(instance)
        return solver.solve()
    except Exception as error:
        spent, said = time.perf_counter() - began, f"{type(error).__name__}: {error}"
        nothing = (None, None, Status.ERROR, NOT_JUDGED)
        return Solution(*nothing, spent, message=said)


def _residuals(answers: Sequence[Solution]) -> dict[str, list[float | None]]:
    absolute = ("primal", "dual", "gap", "complementarity")
    found = {
        name: [_finite(getattr(a.residual, name)) for a in answers] for name in absolute
    }
    return {**found, "relative": [_finite(a.relative.worst) for a in answers]}


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _scaled(value: float | None, factor: float) -> float | None:
    return None if value is None else factor * value


def _digest(problems: ProblemSet) -> str:
    """Digest of the numbers of a set."""
    digest = hashlib.sha256()
    for instance in problems.instances:
        for part in instance.problem.unpack_as_dense():
            data = b"none" if part is None else np.ascontiguousarray(part).tobytes()
            digest.update(data)
    return digest.hexdigest()[:16]
