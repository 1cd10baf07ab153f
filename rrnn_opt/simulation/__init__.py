"""Closed loops of robot and network, run whole in compiled C."""

from rrnn_opt.simulation.result import SimulationResult
from rrnn_opt.simulation.simulate import simulate
from rrnn_opt.simulation.task import Control, Curve, Noise, Task

__all__ = ["Control", "Curve", "Noise", "SimulationResult", "Task", "simulate"]
