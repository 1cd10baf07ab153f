"""Built-in robots, one file each; a module is imported when it is asked for."""

from __future__ import annotations

import importlib

from rrnn_opt.arguments import checked
from rrnn_opt.errors import RobotError
from rrnn_opt.robot.data import RobotData

BUILTIN = ("pa10", "panda", "raven2", "planar3")

__all__ = ["BUILTIN", "builtin"]


@checked()
def builtin(name: str) -> RobotData:
    """The built-in robot of that name.

    Args:
        name: one of ``BUILTIN``.

    Returns:
        The robot.

    Raises:
        RobotError: no robot has that name.
    """
    if name not in BUILTIN:
        known = ", ".join(BUILTIN)
        raise RobotError(name, f"not a built-in robot; there are {known}")
    robot: RobotData = importlib.import_module(f"rrnn_opt.robot.builtin.{name}").robot()
    return robot
