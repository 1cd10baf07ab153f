"""Robots as frozen arrays, and their symbolic kinematics.

``Robot`` is data; ``Kinematics`` writes its forward kinematics in CasADi.
Only ``loading`` knows pinocchio, and only it reads URDF files.
"""

from rrnn_opt.robot.kinematics import Kinematics
from rrnn_opt.robot.robot import Frame, JointTree, Limits, Robot, Sphere

__all__ = ["Frame", "JointTree", "Kinematics", "Limits", "Robot", "Sphere"]
