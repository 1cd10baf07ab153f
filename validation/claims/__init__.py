"""Statements of the paper, one file each, as claims that can be settled.

Source of all of them: Y. Li, S. Li, B. Hannaford, "A Model-Based Recurrent
Neural Network With Randomness for Efficient Control With Applications", IEEE
Trans. Industrial Informatics 15(4):2054-2063, 2019,
doi:10.1109/TII.2018.2869588.
"""

from __future__ import annotations

from rrnn_opt.robot import Kinematics
from rrnn_opt.validation.claims import c17, c18, c19, c29
from rrnn_opt.verification import ClaimCase

__all__ = ["claims"]


def claims(kinematics: Kinematics) -> list[ClaimCase]:
    """Every statement, for one robot where it speaks of a robot.

    Args:
        kinematics: kinematics of the robot.

    Returns:
        Cases in the order of the paper's equations.
    """
    return [c17.case(kinematics), c18.case(kinematics), c19.case(), c29.case()]
