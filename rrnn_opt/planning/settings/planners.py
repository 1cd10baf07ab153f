"""The planners by name, each with its settings."""

from __future__ import annotations

from rrnn_opt.planning.settings.random_rnn import RandomRnn
from rrnn_opt.planning.settings.rollout import PaperRnn, RolloutSettings, SingleRollout

PlannerSettings = RandomRnn | RolloutSettings

PLANNERS: dict[str, PlannerSettings] = {
    "random-rnn": RandomRnn(),
    "no-learning": RandomRnn(coin=0.5),
    "paper": PaperRnn(),
    "method1": SingleRollout(level="velocity"),
    "method2": SingleRollout(level="acceleration"),
}
"""What each planner's name stands for; the type decides the search."""
