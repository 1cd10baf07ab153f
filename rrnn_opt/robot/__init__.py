"""Robots as frozen arrays, and their symbolic kinematics.

``Robot`` is data (``RobotData``) and the ways to get it; ``Kinematics`` writes its
forward kinematics in CasADi and is imported when first used, so that looking at a
robot costs no CasADi.
``loading`` alone reads URDF files; ``fitting`` lays spheres over their geometry.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rrnn_opt.robot.data import RobotData
from rrnn_opt.robot.robot import Robot
from rrnn_opt.robot.tree import Frame, JointTree, Limits, Sphere

if TYPE_CHECKING:
    from rrnn_opt.robot.kinematics import Kinematics

__all__ = ["Frame", "JointTree", "Kinematics", "Limits", "Robot", "RobotData", "Sphere"]


def __getattr__(name: str) -> Any:
    if name == "Kinematics":
        from rrnn_opt.robot.kinematics import Kinematics

        return Kinematics
    raise AttributeError(f"module 'rrnn_opt.robot' has no attribute '{name}'")
