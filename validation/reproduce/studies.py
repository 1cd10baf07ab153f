"""Tables I and II and Figures 3 to 5 as studies, cell by cell or row by row."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from rrnn_opt.planning import PaperRnn, Problem, SingleRollout, plan
from rrnn_opt.planning.settings.planners import PlannerSettings
from rrnn_opt.study import Case
from rrnn_opt.validation.figures.figure_3 import COLUMNS, GAINS
from rrnn_opt.validation.figures.figure_4 import STARTS
from rrnn_opt.validation.figures.figure_5 import activities
from rrnn_opt.validation.tables import table_1, table_2
from rrnn_opt.validation.tables.models import MODELS
from rrnn_opt.validation.tables.starts import start_problem
from rrnn_opt.validation.tables.tracking import ENTRIES, SIGMAS, Runner
from rrnn_opt.validation.tables.trials import SCENARIOS, TRIALS

Metrics = Mapping[str, Any]


@dataclass(frozen=True)
class Marks:
    """Table I; one case a cell.

    Attributes:
        runs: random starts of a check.
    """

    runs: int
    name: str = "table1"

    def __iter__(self) -> Iterator[Case]:
        """Row by row."""
        for model in MODELS:
            for column in table_1.columns(self.runs):
                where = {"row": model.row, "column": column, "runs": self.runs}
                yield Case(f"{model.row}/{column}", where)

    def measure(self, case: Case, rng: np.random.Generator) -> Metrics:
        """What the check found on our model of the row."""
        row, column = case.parameters["row"], case.parameters["column"]
        (model,) = (m for m in MODELS if m.row == row)
        found = table_1.mark(model, column, runs=self.runs)
        said = {"ours": found.ours, "saw": found.reason, "runs": self.runs}
        return {"row": row, "column": column, **said}


@dataclass(frozen=True)
class Errors:
    """Table II; one case a row: its gains searched, then its runs.

    Attributes:
        seeds: noise seeds of each circle and sigma.
        points: of the search of the gains.
    """

    seeds: int
    points: int
    name: str = "table2"

    def __iter__(self) -> Iterator[Case]:
        """The rows for which the paper has numbers."""
        for key, entry in ENTRIES.items():
            if entry.paper:
                given = {"key": key, "seeds": self.seeds, "points": self.points}
                yield Case(f"{key}/{self.seeds}", given)

    def measure(self, case: Case, rng: np.random.Generator) -> Metrics:
        """Root mean square errors, (sigmas, circles, seeds), m; and the gains."""
        key = case.parameters["key"]
        found = table_2.measure(key, seeds=self.seeds, points=self.points)
        return {
            "key": key,
            "errors_m": found.errors.tolist(),
            "gains": dict(found.trials[0].gains),
        }


@dataclass(frozen=True)
class Curves:
    """Figure 3; one case a panel.

    Attributes:
        seeds: noise seeds of each panel.
    """

    seeds: int
    name: str = "fig3"

    def __iter__(self) -> Iterator[Case]:
        """Panel by panel, as the paper counts them."""
        for sigma in SIGMAS:
            for key in COLUMNS:
                where = {"key": key, "sigma": sigma, "seeds": self.seeds}
                yield Case(f"{key}/{sigma}/{self.seeds}", where)

    def measure(self, case: Case, rng: np.random.Generator) -> Metrics:
        """Mean square error of the first and last quarter, over all seeds, m2."""
        key, sigma = case.parameters["key"], case.parameters["sigma"]
        runner = Runner(ENTRIES[key], GAINS.get(key, {}))
        squares = []
        for seed in range(self.seeds):
            error = runner.run("A", sigma, seed).error
            squares.append(np.sum(error**2, axis=1))
        mean = np.mean(squares, axis=0)
        quarter = len(mean) // 4
        return {
            "key": key,
            "sigma": sigma,
            "n": self.seeds,
            "first_m2": float(np.mean(mean[:quarter])),
            "last_m2": float(np.mean(mean[-quarter:])),
        }


@dataclass(frozen=True)
class Ways:
    """Figure 4; one case a panel."""

    name: str = "fig4"

    def __iter__(self) -> Iterator[Case]:
        """Panel by panel, as the paper counts them."""
        for scenario in SCENARIOS:
            for scheme in ("method1", "method2", "random-rnn"):
                where = {"scenario": scenario, "planner": scheme}
                yield Case(f"{scenario}/{scheme}", {**where, "start": STARTS[scenario]})

    def measure(self, case: Case, rng: np.random.Generator) -> Metrics:
        """Whether the panel's motion reaches the target, with a proof."""
        scenario, name = case.parameters["scenario"], case.parameters["planner"]
        problem = Problem.from_dict(start_problem(scenario, STARTS[scenario]))
        settings: PlannerSettings = TRIALS[name]
        single = isinstance(settings, SingleRollout)
        budget = 1 if single else 20_000
        result = plan(problem, seed=0, settings=settings, max_explorations=budget)
        return {
            "scenario": scenario,
            "planner": name,
            "status": result.status,
            "reached": result.solved,
        }


@dataclass(frozen=True)
class Activities:
    """Figure 5; one case a search.

    Attributes:
        starts: searches of each scenario.
    """

    starts: int
    name: str = "fig5"

    def __iter__(self) -> Iterator[Case]:
        """Scenario by scenario."""
        for scenario in SCENARIOS:
            for k in range(self.starts):
                yield Case(f"{scenario}/{k}", {"scenario": scenario, "start": k})

    def measure(self, case: Case, rng: np.random.Generator) -> Metrics:
        """The cell's activity before each exploration, literally as printed."""
        scenario, start = case.parameters["scenario"], case.parameters["start"]
        curve = _activities(scenario, self.starts)[start]
        return {
            "scenario": scenario,
            "start": start,
            "mean": float(np.mean(curve)),
            "largest": float(np.max(curve)),
            "explorations": len(curve),
        }


@lru_cache(maxsize=4)
def _activities(scenario: str, starts: int) -> list[Any]:
    return activities(scenario, PaperRnn(feed="failure"), starts, 60)
