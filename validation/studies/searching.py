"""Searches without delivery, for studies that count explorations."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from rrnn_opt.planning import Problem
from rrnn_opt.planning.settings.planners import PlannerSettings
from rrnn_opt.report.files import write_text
from rrnn_opt.study import Case, wilson
from rrnn_opt.validation.tables.cell import markdown
from rrnn_opt.validation.tables.collect import collect, surroundings
from rrnn_opt.validation.tables.searched import searched
from rrnn_opt.validation.tables.starts import start_problem


@dataclass(frozen=True)
class Searches:
    """Variants of a planner on the same starts with the same seeds.

    Attributes:
        name: of the study.
        variants: settings by the name of their row.
        trials: of each variant in each scenario.
        scenarios: names of shipped scenarios.
        budget: explorations at most.
    """

    name: str
    variants: Mapping[str, PlannerSettings]
    trials: int
    scenarios: tuple[str, ...] = ("plane", "window")
    budget: int = 2000

    def __iter__(self) -> Iterator[Case]:
        """Scenario by scenario, variant by variant."""
        for scene in self.scenarios:
            for variant, settings in self.variants.items():
                how = {"settings": repr(settings), "budget": self.budget}
                for i in range(self.trials):
                    where = {"scenario": scene, "variant": variant, "trial": i}
                    yield Case(f"{scene}/{variant}/{i}", {**where, **how})

    def measure(self, case: Case, rng: np.random.Generator) -> Mapping[str, Any]:
        """One search; the seed is the trial's."""
        where = {k: case.parameters[k] for k in ("scenario", "variant", "trial")}
        problem = Problem.from_dict(start_problem(where["scenario"], where["trial"]))
        settings = self.variants[where["variant"]]
        return {**where, **searched(problem, settings, where["trial"], self.budget)}


def picked(
    rows: Sequence[dict[str, Any]], scenario: str, variant: str
) -> list[dict[str, Any]]:
    """The searches of one variant in one scenario."""
    return [r for r in rows if (r["scenario"], r["variant"]) == (scenario, variant)]


def compared(
    name: str,
    title: str,
    variants: Mapping[str, PlannerSettings],
    argv: Sequence[str] | None,
    *,
    trials: int,
    budget: int,
) -> Path:
    """Run what is missing of a study, write its page and return the page's path."""
    study, rows, made, out = run_study(
        name, variants, argv, trials=trials, budget=budget
    )
    text = f"# {title}\n\n{made}\n\n{summary(rows, study)}\n"
    return write_text(out / f"{name}.md", text)


def summary(rows: Sequence[dict[str, Any]], study: Searches) -> str:
    """Success, explorations and time of every variant, in Markdown."""
    lines = []
    for scene in study.scenarios:
        for variant in study.variants:
            mine = picked(rows, scene, variant)
            solved = sum(r["solved"] for r in mine)
            low, high = wilson(solved, len(mine))
            totals = [r["total"] for r in mine]
            times = [r["plan_ms"] for r in mine]
            lines.append(
                (
                    scene,
                    variant,
                    f"{solved / len(mine):.1%}",
                    f"{low:.1%} to {high:.1%}",
                    float(np.mean([r["random"] for r in mine])),
                    float(np.mean([r["heuristic"] for r in mine])),
                    float(np.mean(totals)),
                    float(np.percentile(totals, 95)),
                    float(np.percentile(times, 50)),
                    float(np.percentile(times, 95)),
                )
            )
    head = ("scenario", "variant", "success", "95 % interval", "random", "heuristic")
    tail = ("total", "total p95", "p50 ms", "p95 ms")
    return markdown((*head, *tail), lines)


def run_study(
    name: str,
    variants: Mapping[str, PlannerSettings],
    argv: Sequence[str] | None,
    *,
    trials: int,
    budget: int,
) -> tuple[Searches, list[dict[str, Any]], str, Path]:
    """Run what is missing of a study from its command line.

    Returns:
        The study, its rows, the lines on how they were made, and the folder.
    """
    parser = argparse.ArgumentParser(description=name)
    parser.add_argument("--trials", type=int, default=trials)
    parser.add_argument("--budget", type=int, default=budget)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--out", type=Path, default=Path("runs"))
    args = parser.parse_args(argv)
    study = Searches(name, variants, args.trials, budget=args.budget)
    rows = collect(study, args.out / name, jobs=args.jobs)
    command = (
        f"python -m rrnn_opt.validation.studies.{name} --trials {args.trials}"
        f" --budget {args.budget} --jobs {args.jobs}"
    )
    return study, rows, surroundings(command), args.out
