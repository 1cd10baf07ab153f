"""Schemes: each a function that returns a Formulation; one file, one scheme."""

from rrnn_opt.formulations.minimum_velocity import minimum_velocity
from rrnn_opt.formulations.position_feedback import position_feedback
from rrnn_opt.formulations.slide import slide

__all__ = ["minimum_velocity", "position_feedback", "slide"]
