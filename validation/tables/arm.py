"""The arm of Table I."""

from __future__ import annotations

from functools import lru_cache

from rrnn_opt.robot import Kinematics, Robot


@lru_cache(maxsize=1)
def arm() -> tuple[Robot, Kinematics]:
    """The PA10 and its kinematics."""
    robot = Robot.builtin("pa10")
    return robot, Kinematics(robot)
