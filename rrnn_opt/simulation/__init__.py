"""Closed loops of robot and network, run whole in compiled C."""

from rrnn_opt.simulation.result import SimulationResult
from rrnn_opt.simulation.simulate import simulate
from rrnn_opt.simulation.task import Control, Curve, Noise, Task
from rrnn_opt.simulation.task_file import load_task, task_from_dict

__all__ = [
    "Control",
    "Curve",
    "Noise",
    "SimulationResult",
    "Task",
    "load_task",
    "simulate",
    "task_from_dict",
]
