"""Which compiled runtime and which search a planner's settings stand for."""

from __future__ import annotations

from rrnn_opt.planning.rollout.library import RolloutSearch, rollout_runtime_of
from rrnn_opt.planning.search.cache import runtime_of
from rrnn_opt.planning.search.library import Runtime, Search
from rrnn_opt.planning.search.request import PackedRequest
from rrnn_opt.planning.settings.planners import PlannerSettings
from rrnn_opt.planning.settings.random_rnn import RandomRnn
from rrnn_opt.robot import Robot


def runtime_for(robot: Robot, settings: PlannerSettings) -> Runtime:
    """The robot's compiled planner, built at its first use.

    Raises:
        CompilerError: there is no C compiler, or it failed.
    """
    if isinstance(settings, RandomRnn):
        return runtime_of(robot, settings.cell)
    return rollout_runtime_of(robot, settings)


def open_search(
    runtime: Runtime, settings: PlannerSettings, packed: PackedRequest
) -> Search:
    """A search for the packed request; use it as a context manager."""
    if isinstance(settings, RandomRnn):
        return Search(runtime, settings, packed.struct, packed.keep)
    return RolloutSearch(runtime, settings, packed.struct, packed.keep)
