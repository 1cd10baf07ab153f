"""Where the time goes from a command to its result, on a warm cache unless said.

CPU times, children included.  Stages and commands: the least of three fresh
processes, each; the stages follow one another in one process, and `rrnn plan` does
the same.  Plans: one warm process, 20 problems a family, least of three runs of
each; the parts are shares of the whole.  Two processes, started anew each time: this
machine may be busy, so what counts is the CPU time that the busier one has spent,
which is what an idle machine would have to wait for; least of three rounds.
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

import rrnn_opt as rr
from benchmarks.record import Benchmark, Row
from benchmarks.search.cases import cases
from rrnn_opt.planning import Problem
from rrnn_opt.planning.search.library import Search

PARTS = ("search", "refine", "retime", "certificate")
ROUNDS, REPEATS, PLANS, MANY = 3, 3, 20, 560
STAGES = """
import json, sys, time
import resource

def spent():
    ours, theirs = (resource.getrusage(who) for who in
                    (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return ours.ru_utime + ours.ru_stime + theirs.ru_utime + theirs.ru_stime

marks = [("interpreter", spent())]

def mark(name):
    marks.append((name, spent()))

import rrnn_opt as rr
mark("import rrnn_opt")
from rrnn_opt.planning import Problem, RandomRnn, plan
mark("import the planner (numpy, CasADi)")
problem = Problem.load(sys.argv[1])
mark("read the problem")
from rrnn_opt.planning.searches import runtime_for
runtime_for(problem.robot, RandomRnn())
mark("emit the robot's planner, find it compiled")
from rrnn_opt.motion import toppra_loading
toppra_loading.load()
mark("import toppra (SciPy's splines)")
result = plan(problem, keep_trees=True)
mark("first plan: search to certificate")
document = result.to_dict()
json.dumps(document)
mark("result as JSON")
from rrnn_opt.report import write_plan
write_plan(document, sys.argv[2])
mark("pictures and page (matplotlib)")
before = [("", 0.0), *marks]
print(json.dumps([[n, t - b[1]] for (n, t), b in zip(marks, before)]))
"""


def spent_by_children() -> float:
    """CPU seconds of all processes that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def fresh(command: list[str], **more: Any) -> tuple[float, str]:
    """CPU seconds and output of a command."""
    before = spent_by_children()
    done = subprocess.run(command, capture_output=True, text=True, check=True, **more)
    return spent_by_children() - before, done.stdout


def stages(
    problem: Path, folder: Path, environment: dict[str, str]
) -> dict[str, float]:
    """CPU seconds of each stage in one fresh process."""
    command = [sys.executable, "-c", STAGES, str(problem), str(folder)]
    return dict(json.loads(fresh(command, env=environment)[1]))


def least(call: Callable[[], dict[str, float]]) -> dict[str, float]:
    """The least of each entry over some calls."""
    found = [call() for _ in range(ROUNDS)]
    return {name: min(one[name] for one in found) for name in found[0]}


def commands(problem: Path, folder: Path) -> dict[str, float]:
    """CPU seconds of commands as a user types them."""
    program = "from rrnn_opt.cli.start import main; raise SystemExit(main())"
    arguments = {
        "--help": [],
        "plan --help": [],
        "plan PROBLEM": [str(problem)],
        "plan PROBLEM --out DIR": [str(problem), "--out", str(folder / "out")],
    }
    found = {"python -c pass": fresh([sys.executable, "-c", "pass"])[0]}
    for name, extra in arguments.items():
        words = [w for w in name.split() if w in ("plan", "--help")]
        command = [sys.executable, "-c", program, *words, *extra]
        found[f"rrnn {name}"] = fresh(command)[0]
    return found


@contextmanager
def watched(inside: list[float]) -> Iterator[None]:
    """Adds up the seconds that the compiled search itself takes."""
    usual: Any = Search._call

    def call(self: Search, name: str, *rest: Any) -> Any:
        begin = time.perf_counter()
        try:
            return usual(self, name, *rest)
        finally:
            if name == "run":
                inside[0] += time.perf_counter() - begin

    setattr(Search, "_call", call)  # noqa: B010
    try:
        yield
    finally:
        setattr(Search, "_call", usual)  # noqa: B010


def excess(problem: Problem, seed: int) -> float:
    """Seconds by which ``plan_time_s`` exceeds the compiled search, no refining."""
    inside, settings = [0.0], rr.planning.RandomRnn(refinements=0)
    with watched(inside):
        result = rr.plan(problem, seed=seed, settings=settings)
    return float(result.stats.plan_time_s - inside[0])


def planned(problem: Problem, seed: int) -> tuple[float, list[float]]:
    """CPU seconds of the quickest of some runs of a plan, and of its parts."""
    best, parts = np.inf, [0.0] * 4
    for _ in range(REPEATS):
        begin = time.process_time()
        result = rr.plan(problem, seed=seed)
        seconds = time.process_time() - begin
        if not result.solved:
            raise RuntimeError(result.message)
        if seconds < best:
            stats = result.stats
            times = (stats.plan_time_s, stats.refine_time_s, stats.retime_time_s)
            best, parts = seconds, [*times, result.certificate["time_s"]]
    return best, parts


def families() -> dict[str, list[tuple[Problem, int]]]:
    """The two scenarios, and MotionBenchMaker's problems with joint goals."""
    chosen = {}
    for family, goal, problems in cases(PLANS, 1):
        if goal == "joints" or family in ("plane", "window"):
            some = problems[:PLANS]
            chosen[family] = [(Problem.from_dict(d), seed) for d, seed in some]
    return chosen


def two_processes(problems: list[Problem]) -> dict[str, float]:
    """CPU seconds of many plans by one process, and by the busier one of two."""
    begin = time.process_time()
    list(rr.plan_many(problems, jobs=1))
    alone = time.process_time() - begin
    begin, before = time.process_time(), spent_by_children()
    list(rr.plan_many(problems, jobs=2))
    here, there = time.process_time() - begin, spent_by_children() - before
    return {"one process": alone, "two, the busier one": max(here, there)}


def run(benchmark: Benchmark) -> None:
    """Add the rows of stages, commands, plans and processes."""
    every = families()
    rr.plan(*every["plane"][0][:1])
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        problem = folder / "problem.json"
        problem.write_text(json.dumps(every["plane"][0][0].to_dict()))
        warm = least(lambda: stages(problem, folder / "out", dict(os.environ)))
        cold = stages(problem, folder / "out", {**os.environ, "RRNN_CACHE_DIR": name})
        typed = least(lambda: commands(problem, folder))
    for stage, seconds in warm.items():
        benchmark.add(Row(f"stage: {stage}", seconds, "s"))
        if stage.startswith("emit"):
            benchmark.add(Row("stage: with an empty cache", cold[stage], "s"))
    for command, seconds in typed.items():
        benchmark.add(Row(f"command: {command}", seconds, "s"))
    _plans(benchmark, every)
    problems = [p for some in every.values() for p, _ in some]
    problems = (problems * (MANY // len(problems) + 1))[:MANY]
    alone, busier = least(lambda: two_processes(problems)).items()
    benchmark.add(Row(f"{MANY} plans: {alone[0]}", alone[1], "s"))
    gain = alone[1] / busier[1]
    benchmark.add(Row(f"{MANY} plans: {busier[0]}", busier[1], "s", ratio=gain))


def _plans(benchmark: Benchmark, every: dict[str, list[tuple[Problem, int]]]) -> None:
    whole = []
    for family, problems in every.items():
        rr.plan(problems[0][0])
        found = [planned(*pair) for pair in problems]
        seconds = np.array([s for s, _ in found])
        shares = np.sum([p for _, p in found], axis=0)
        shares = shares / np.sum(shares)
        pairs = zip(PARTS, shares, strict=True)
        shown = ", ".join(f"{name} {share:.0%}" for name, share in pairs)
        whole += list(seconds)
        for q in (50, 95):
            label = f"plan, {family}, p{q}" + (f" ({shown})" if q == 50 else "")
            benchmark.add(Row(label, float(np.percentile(seconds, q)), "s"))
    for q in (50, 95):
        benchmark.add(Row(f"plan, all, p{q}", float(np.percentile(whole, q)), "s"))
    over = [excess(*pair) for pair in every["window"]]
    for q in (50, 95):
        label = f"plan_time_s beyond the search in C, p{q}"
        benchmark.add(Row(label, float(np.percentile(over, q)), "s"))
