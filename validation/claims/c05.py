"""C5: Omega stands for two different sets, (3c) and the text below it."""

from __future__ import annotations

from rrnn_opt.robot import Kinematics
from rrnn_opt.verification import Remark


def case(kinematics: Kinematics) -> Remark:
    """Both q and q' lie in Omega: a slip of types, not a statement.

    Args:
        kinematics: not used.
    """
    return Remark(
        id="C5",
        source="eq. (3), (9)",
        statement="Omega is the configuration space, and the set of joint velocities",
        kind="NO_PROPOSITION",
        reason="one letter for two sets: radians in one place, radians a second in "
        "the other; here Omega(q) is the box of velocities (10)",
    )
