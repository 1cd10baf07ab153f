"""Schemes: each a function that returns a Formulation; one file, one scheme."""

from rrnn_opt.formulations.classical import classical
from rrnn_opt.formulations.clearance_rows import clearance_rows
from rrnn_opt.formulations.closed_loop import closed_loop
from rrnn_opt.formulations.damped_least_squares import damped_least_squares
from rrnn_opt.formulations.gradient_projection import gradient_projection
from rrnn_opt.formulations.infinity_norm import infinity_norm
from rrnn_opt.formulations.joint_limit_avoidance import joint_limit_avoidance
from rrnn_opt.formulations.joint_sign_sets import joint_sign_sets
from rrnn_opt.formulations.manipulability import manipulability
from rrnn_opt.formulations.method1 import method1
from rrnn_opt.formulations.method2 import method2
from rrnn_opt.formulations.method3 import method3
from rrnn_opt.formulations.minimum_acceleration import minimum_acceleration
from rrnn_opt.formulations.minimum_velocity import minimum_velocity
from rrnn_opt.formulations.model35 import model35
from rrnn_opt.formulations.model36 import model36
from rrnn_opt.formulations.model43 import model43
from rrnn_opt.formulations.position_feedback import position_feedback
from rrnn_opt.formulations.prioritised_tasks import prioritised_tasks
from rrnn_opt.formulations.quiet_posture import quiet_posture
from rrnn_opt.formulations.repetitive_motion import repetitive_motion
from rrnn_opt.formulations.sign_rows import sign_rows
from rrnn_opt.formulations.slack_task import slack_task
from rrnn_opt.formulations.slide import slide
from rrnn_opt.formulations.task_augmentation import task_augmentation

__all__ = [
    "classical",
    "clearance_rows",
    "closed_loop",
    "damped_least_squares",
    "gradient_projection",
    "infinity_norm",
    "joint_limit_avoidance",
    "joint_sign_sets",
    "manipulability",
    "method1",
    "method2",
    "method3",
    "minimum_acceleration",
    "minimum_velocity",
    "model35",
    "model36",
    "model43",
    "position_feedback",
    "prioritised_tasks",
    "quiet_posture",
    "repetitive_motion",
    "sign_rows",
    "slack_task",
    "slide",
    "task_augmentation",
]
