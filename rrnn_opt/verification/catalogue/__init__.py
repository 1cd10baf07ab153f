"""Claims that come with a formulation and its network, for any robot."""

from __future__ import annotations

from rrnn_opt.formulation import Formulation
from rrnn_opt.networks import Network
from rrnn_opt.robot import Kinematics
from rrnn_opt.verification.case import ClaimCase
from rrnn_opt.verification.catalogue.motion import reduced_law_decreases

__all__ = ["claims", "reduced_law_decreases"]


def claims(form: Formulation, network: Network, kin: Kinematics) -> list[ClaimCase]:
    """What is claimed of a scheme, solved by a network, on a robot.

    Args:
        form: the scheme.
        network: the rule that solves it.
        kin: kinematics of the robot.
    """
    found = []
    if form.name == "position_feedback":
        found.append(ClaimCase(reduced_law_decreases(kin)))
    return found
