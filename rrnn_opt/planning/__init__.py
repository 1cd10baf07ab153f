"""Planning: problems, the random-RNN planner and its compiled runtime."""

from rrnn_opt.planning.many import plan_many
from rrnn_opt.planning.planner import plan
from rrnn_opt.planning.problem.goals import JointGoal, TipGoal
from rrnn_opt.planning.problem.problem import Problem
from rrnn_opt.planning.result import PlanResult, PlanStats
from rrnn_opt.planning.settings.planners import PLANNERS
from rrnn_opt.planning.settings.random_rnn import RandomRnn
from rrnn_opt.planning.settings.rollout import PaperRnn, SingleRollout

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
