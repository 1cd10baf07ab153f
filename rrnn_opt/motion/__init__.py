"""From a path to a timed motion that is proved as delivered."""

from rrnn_opt.motion.deliver import Attempt, Delivery, deliver
from rrnn_opt.motion.path import Path
from rrnn_opt.motion.retime import RetimeSettings, retime
from rrnn_opt.motion.shortcut import shortcut
from rrnn_opt.motion.stop_and_go import stop_and_go
from rrnn_opt.motion.trajectory import Trajectory

__all__ = [
    "Attempt",
    "Delivery",
    "Path",
    "RetimeSettings",
    "Trajectory",
    "deliver",
    "retime",
    "shortcut",
    "stop_and_go",
]
