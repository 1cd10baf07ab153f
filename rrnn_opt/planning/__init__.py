"""Planning: problems, the random-RNN planner and its compiled runtime."""

from rrnn_opt.planning.goals import JointGoal, TipGoal
from rrnn_opt.planning.many import plan_many
from rrnn_opt.planning.planner import plan
from rrnn_opt.planning.problem import Problem
from rrnn_opt.planning.result import PlanResult, PlanStats
from rrnn_opt.planning.rollout_settings import PaperRnn, SingleRollout
from rrnn_opt.planning.settings import PLANNERS, RandomRnn

__all__ = [
    "PLANNERS",
    "JointGoal",
    "PaperRnn",
    "PlanResult",
    "PlanStats",
    "Problem",
    "RandomRnn",
    "SingleRollout",
    "TipGoal",
    "plan",
    "plan_many",
]
