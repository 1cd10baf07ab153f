"""Closed loops of robot and network, run whole in compiled C."""

from rrnn_opt.simulation.result import SimulationResult
from rrnn_opt.simulation.simulate import simulate
from rrnn_opt.simulation.task import Task
from rrnn_opt.simulation.task_parts import Control, Curve, Noise

__all__ = [
    "Control",
    "Curve",
    "Noise",
    "SimulationResult",
    "Task",
    "simulate",
]
