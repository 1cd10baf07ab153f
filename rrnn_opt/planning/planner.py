"""``plan``: from a problem to a certified, retimed trajectory."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from rrnn_opt import check
from rrnn_opt.arguments import checked
from rrnn_opt.errors import ProblemError, RetimeError
from rrnn_opt.motion import Delivery, Trajectory, deliver
from rrnn_opt.planning.problem.problem import Problem
from rrnn_opt.planning.result import PlanResult
from rrnn_opt.planning.rollout.library import point_goals, thinned
from rrnn_opt.planning.run import Run
from rrnn_opt.planning.search.cache import judge_of
from rrnn_opt.planning.search.feasibility import (
    Infeasible,
    OpenGoals,
    blocked,
    open_goals,
)
from rrnn_opt.planning.search.library import SLICE_S, Runtime, Search
from rrnn_opt.planning.search.refine import length, refine
from rrnn_opt.planning.search.request import pack
from rrnn_opt.planning.search.tool import tool_blocked
from rrnn_opt.planning.search.trees import tree_document
from rrnn_opt.planning.searches import open_search, runtime_for
from rrnn_opt.planning.settings.planners import PLANNERS, PlannerSettings
from rrnn_opt.planning.settings.random_rnn import RandomRnn
from rrnn_opt.planning.settings.rollout import SingleRollout

Array = NDArray[np.float64]
Progress = Callable[[str, int], None]
DEFAULT_EXPLORATIONS = 20_000


@checked()
def plan(
    problem: Problem,
    *,
    seed: int = 0,
    planner: str = "random-rnn",
    settings: PlannerSettings | None = None,
    time_limit: float | None = None,
    max_explorations: int = DEFAULT_EXPLORATIONS,
    on_progress: Progress | None = None,
    keep_trees: bool = False,
    improve_s: float = 0.0,
) -> PlanResult:
    """Plan, shorten, retime and certify.

    Args:
        problem: robot, start, goals and scene.
        seed: of all randomness; without a time limit the same seed gives the
            same plan on the same machine and compiler.
        planner: a name of ``PLANNERS``: "random-rnn"; "no-learning", with a fair
            coin for the cell; "paper", Algorithm 1 as printed; "method1" and
            "method2", single rollouts of the comparison schemes.
        settings: numbers of the planner; by default those of its name.
        time_limit: seconds for the search, or None.
        max_explorations: rollouts started at most.
        on_progress: called with the stage and the explorations so far.
        improve_s: seconds to go on shortening after the first solution, within
            which a clock decides the path; 0 leaves it to the settings' rounds.
        keep_trees: also hand out both trees, nodes and parents, for pictures.

    Returns:
        A result in every case that the problem's data allow; see its status.

    Raises:
        ProblemError: the planner's name, the seed or a budget is not valid, or the
            planner cannot be given such a goal.
        CompilerError: there is no C compiler.
    """
    chosen = settings or _settings(planner)
    if max_explorations < 1 or (time_limit is not None and not time_limit > 0.0):
        raise ProblemError("budget", "explorations and time limit must be positive")
    if seed < 0:
        raise ProblemError("seed", f"must be zero or more, not {seed}")
    if not 0.0 <= improve_s < np.inf:
        raise ProblemError("improve", f"must be seconds, zero or more, not {improve_s}")
    begin = time.perf_counter()
    run = Run(problem, seed, planner, chosen, begin, improve_s, keep_trees=keep_trees)
    begin = time.perf_counter()
    runtime = runtime_for(problem.robot, chosen)
    run.figures["compile_time_s"] = time.perf_counter() - begin
    return _planned(run, runtime, time_limit, max_explorations, on_progress)


def _settings(planner: str) -> PlannerSettings:
    if planner not in PLANNERS:
        known = ", ".join(PLANNERS)
        raise ProblemError("planner", f"no planner '{planner}'; there are {known}")
    return PLANNERS[planner]


def _planned(
    run: Run,
    runtime: Runtime,
    time_limit: float | None,
    budget: int,
    on_progress: Progress | None,
) -> PlanResult:
    packed = pack(run.problem, (), (), run.seed)
    with open_search(runtime, run.settings, packed) as probe:
        hit = blocked(run.problem, probe, run.problem.start, "start")
        goals = hit or open_goals(run.problem, probe)
    if isinstance(goals, Infeasible):
        return run.result("infeasible", goals.message, witness=goals.witness)
    if not isinstance(run.settings, RandomRnn):
        goals = point_goals(goals, run.planner)
    packed = pack(run.problem, goals.joints, goals.tips, run.seed)
    with open_search(runtime, run.settings, packed) as search:
        try:
            status = _search(run, search, time_limit, budget, on_progress)
            if status == "solved":
                if on_progress is not None:
                    on_progress("deliver", len(search.path()))
                return _delivered(run, search, runtime, goals)
        except KeyboardInterrupt:
            return run.result("interrupted", "what was found is kept")
        return _without_path(run, status, goals)


def _without_path(run: Run, status: str, goals: OpenGoals) -> PlanResult:
    """Why there is no path; where no goal posture was found perhaps with a proof."""
    if status == "no_goal_posture":
        proofs = [tool_blocked(run.problem, goal) for goal in goals.tips]
        known = [proof for proof in proofs if proof is not None]
        if len(known) == len(proofs):
            message, witness = known[0].message, known[0].witness
            return run.result("infeasible", message, witness=witness)
    return run.result(status, _why(status, run, goals))


def _search(
    run: Run,
    search: Search,
    time_limit: float | None,
    budget: int,
    on_progress: Progress | None,
) -> str:
    begin = time.perf_counter()
    limit = np.inf if time_limit is None else time_limit
    status = "paused"
    try:
        while status in ("paused", "cancelled"):
            left = limit - (time.perf_counter() - begin)
            if left <= 0.0:
                return "time_limit"
            if status == "cancelled":  # by a Ctrl-C that its handler did not raise
                raise KeyboardInterrupt
            status = search.run(budget, min(SLICE_S, left), left)
            if on_progress is not None:
                counts = search.counts()
                on_progress("plan", counts.random + counts.heuristic)
    finally:
        run.figures["plan_time_s"] = time.perf_counter() - begin
        run.counts = search.counts()
        run.activity = tuple(float(x) for x in search.activity())
        if run.keep_trees:
            run.trees = tree_document(search)
    return status


def _why(status: str, run: Run, goals: OpenGoals) -> str:
    if status == "budget_exhausted" and isinstance(run.settings, SingleRollout):
        return "the single rollout did not reach the goal; this proves nothing"
    if status == "no_goal_posture" and isinstance(run.settings, RandomRnn):
        tries = run.settings.ik_tries + 1
        return (
            f"inverse kinematics found no free goal posture in {tries} tries for"
            f" {len(goals.tips)} goal(s); this is no proof that there is none"
        )
    spent = {"budget_exhausted": "explorations were", "time_limit": "time was"}[status]
    return f"no path found before the {spent} spent; this proves nothing"


def _delivered(
    run: Run, search: Search, runtime: Runtime, goals: OpenGoals
) -> PlanResult:
    """Refine, retime and certify the path found; a path is kept in any case."""
    begin = time.perf_counter()
    run.path = _refined(run, search, runtime, goals)
    run.figures["path_length"] = length(run.path)
    run.figures["refine_time_s"] = time.perf_counter() - begin
    try:
        delivery = _timed(run, run.path)
    except RetimeError as error:
        return run.result("uncertified", f"path found, but not timed: {error}")
    run.trajectory = delivery.trajectory
    run.certificate = delivery.certificate.to_dict()
    if delivery.certificate.proved:
        return run.result("solved", "trajectory found and proved")
    message = "path found, but its trajectory could not be proved; the path is kept"
    return run.result("uncertified", message)


def _refined(run: Run, search: Search, runtime: Runtime, goals: OpenGoals) -> Array:
    """The path found: shortened if it is of slides, thinned if it was rolled out."""
    run.path = search.path()
    if not isinstance(run.settings, RandomRnn):
        return thinned(search, run.path)

    def another(number: int) -> Search:
        packed = pack(run.problem, goals.joints, goals.tips, run.seed, number)
        return open_search(runtime, run.settings, packed)

    refined = refine(
        search,
        another,
        run.settings,
        run.seed,
        shortest=goals.nearest(run.problem.start),
        improve_s=run.improve_s,
    )
    run.figures["refinements"] = refined.rounds
    run.figures["first_path_length"] = refined.first_length
    return refined.path


def _timed(run: Run, path: Array) -> Delivery[check.TrajectoryCertificate]:
    """Retime and certify; the certificate's own time is left out."""
    problem, judge = run.problem.to_dict(), judge_of(run.problem.robot)
    begin, checking = time.perf_counter(), 0.0

    def certify(trajectory: Trajectory) -> check.TrajectoryCertificate:
        nonlocal checking
        start = time.perf_counter()
        rows = {**trajectory.columns(), "duration": trajectory.duration}
        verdict = judge.certify(problem, rows)
        checking += time.perf_counter() - start
        return verdict

    try:
        return deliver(path, run.problem.robot.limits, certify)
    finally:
        run.figures["retime_time_s"] = time.perf_counter() - begin - checking
