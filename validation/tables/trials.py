"""Planning trials: planners, scenarios and starts as a study."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from rrnn_opt.planning import PaperRnn, Problem, RandomRnn, SingleRollout, plan
from rrnn_opt.planning.settings.planners import PlannerSettings
from rrnn_opt.study import Case
from rrnn_opt.validation.tables.searched import searched
from rrnn_opt.validation.tables.starts import start_problem

SCENARIOS = ("plane", "window")
"""The paper's scenarios 1 and 2, in our dimensions."""
TRIALS: dict[str, PlannerSettings] = {
    "method1": SingleRollout(level="velocity"),
    "method2": SingleRollout(level="acceleration"),
    "paper": PaperRnn(),
    "paper, I = failure": PaperRnn(feed="failure"),
    "paper, coin": PaperRnn(coin=0.5),
    "no-learning": RandomRnn(coin=0.5),
    "random-rnn": RandomRnn(),
}
"""Every planner of tables III and IV, by the name of its row."""
BUDGET = {"random-rnn": 20_000, "no-learning": 20_000}
PAPER_BUDGET = 300


@dataclass(frozen=True)
class PlanningTrials:
    """One case is a planner in a scenario from one start.

    Trial i of every planner has the same start and the same seed, i.

    Attributes:
        trials: of each planner in each scenario.
        printed: of Algorithm 1 as printed, which takes longest; ``trials`` if None.
        planners: names of ``TRIALS``.
        scenarios: names of shipped scenarios.
        name: of the study.
    """

    trials: int = 50
    printed: int | None = None
    planners: tuple[str, ...] = tuple(TRIALS)
    scenarios: tuple[str, ...] = SCENARIOS
    name: str = "planning_trials"
    settings: Mapping[str, PlannerSettings] = field(default_factory=lambda: TRIALS)

    def __iter__(self) -> Iterator[Case]:
        """Scenario by scenario, planner by planner."""
        for scene in self.scenarios:
            for planner in self.planners:
                few = self.printed is not None and planner.startswith("paper")
                how = {"settings": repr(self.settings[planner])}
                for i in range(self.printed or 0 if few else self.trials):
                    where = {"scenario": scene, "planner": planner, "trial": i}
                    yield Case(f"{scene}/{planner}/{i}", {**where, **how})

    def measure(self, case: Case, rng: np.random.Generator) -> Mapping[str, Any]:
        """Status, explorations and processor time of one plan.

        The seed is the trial's.  Only a search that finds a path is planned out,
        by ``plan`` with the same seed; it succeeds when the motion is proved.
        """
        where = {k: case.parameters[k] for k in ("scenario", "planner", "trial")}
        problem = Problem.from_dict(start_problem(where["scenario"], where["trial"]))
        settings = self.settings[where["planner"]]
        budget = BUDGET.get(where["planner"], PAPER_BUDGET)
        found = searched(problem, settings, where["trial"], budget)
        if found["solved"]:
            result = plan(
                problem,
                seed=where["trial"],
                settings=settings,
                max_explorations=budget,
            )
            found |= {"status": result.status, "solved": result.solved}
        return {**where, **found}
