"""Compiled planners, and judges, of the robots that this process has met."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

from rrnn_opt.check import Judge
from rrnn_opt.networks import MemoryCell
from rrnn_opt.planning.search.library import Runtime
from rrnn_opt.robot import Robot


@dataclass(frozen=True)
class RobotKey:
    """A robot and constants that equal others when all their numbers do.

    Attributes:
        text: the robot's numbers.
        constants: what else is compiled in.
        robot: the robot itself.
    """

    text: str
    constants: tuple[Any, ...]
    robot: Robot = field(compare=False)

    @staticmethod
    def of(robot: Robot, *constants: Any) -> RobotKey:
        """The key of a robot."""
        return RobotKey(robot_text(robot), constants, robot)


@lru_cache(maxsize=16)
def _runtime(key: RobotKey) -> Runtime:
    return Runtime(key.robot, *key.constants)


def runtime_of(robot: Robot, cell: MemoryCell) -> Runtime:
    """The compiled planner of a robot, built at its first use.

    A runtime has no state of its own, so that sharing one changes nothing.

    Raises:
        CompilerError: there is no C compiler, or it failed.
    """
    return _runtime(RobotKey.of(robot, cell))


@lru_cache(maxsize=64)
def robot_text(robot: Robot) -> str:
    """The robot block as JSON; robots do not change, so it is written once."""
    return json.dumps(robot.to_dict())


@lru_cache(maxsize=16)
def _judge(text: str) -> Judge:
    return Judge.of(json.loads(text))


def judge_of(robot: Robot) -> Judge:
    """The independent judge of a robot's trajectories, its own copy of the block."""
    return _judge(robot_text(robot))
