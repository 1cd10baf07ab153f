"""C40: "the planning is guaranteed to be complete", section II-C."""

from __future__ import annotations

from rrnn_opt.robot import Kinematics
from rrnn_opt.verification import Remark


def case(kinematics: Kinematics) -> Remark:
    """The sentence is about a local minimum: a "not" is missing.

    Args:
        kinematics: not used.
    """
    return Remark(
        id="C40",
        source="section II-C",
        statement="classical schemes have local minima and are complete",
        kind="NO_PROPOSITION",
        reason="a slip of the pen: the paragraph argues that they are not complete",
    )
