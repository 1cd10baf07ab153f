"""Compiled planners, and judges, of the robots that this process has met."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import lru_cache

from rrnn_opt.check import Judge
from rrnn_opt.networks import MemoryCell
from rrnn_opt.planning.search.library import Runtime
from rrnn_opt.robot import Robot


@dataclass(frozen=True)
class _Key:
    """A robot that equals another when all its numbers do."""

    text: str
    cell: MemoryCell
    robot: Robot

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, _Key)
            and self.text == other.text
            and self.cell == other.cell
        )

    def __hash__(self) -> int:
        return hash((self.text, self.cell))


@lru_cache(maxsize=16)
def _runtime(key: _Key) -> Runtime:
    return Runtime(key.robot, key.cell)


def runtime_of(robot: Robot, cell: MemoryCell) -> Runtime:
    """The compiled planner of a robot, built at its first use.

    A runtime has no state of its own, so that sharing one changes nothing.

    Raises:
        CompilerError: there is no C compiler, or it failed.
    """
    return _runtime(_Key(robot_text(robot), cell, robot))


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
