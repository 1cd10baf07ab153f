"""The task Jacobian of an arm, without the joints that cannot matter.

The singular values of J do not change when the whole arm is turned about its
first joint: J(q) = R(q_1) J(0, q_2, ..), R a rotation, whenever that joint
carries the whole chain.  Joints that the tip's position does not depend on
drop out of the graph by themselves.  So a PA10 has five joints that matter.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np

from rrnn_opt.errors import RobotError
from rrnn_opt.robot import Kinematics
from rrnn_opt.robot.tree import PRISMATIC

FRAME = 1.0 - 1e-12
"""What a rotation that is one within 1e-14 may cost a singular value."""


@dataclass(frozen=True, eq=False)
class ReducedArm:
    """What the theorem needs of an arm.

    Attributes:
        q: the joints that matter, SX (k, 1).
        joints: their numbers, (k,).
        J: task Jacobian in the frame of the first joint, SX (n, nv), of q.
        rows: task coordinates that the arm can move in, (n,).
        turned: number of the joint that was set to 0, or None.
    """

    q: ca.SX
    joints: tuple[int, ...]
    J: ca.SX
    rows: tuple[int, ...]
    turned: int | None

    @staticmethod
    def of(kinematics: Kinematics, frame: str | None = None) -> ReducedArm:
        """Reduce the position Jacobian of a frame.

        Raises:
            RobotError: the arm has fewer joints than the task has coordinates.
        """
        J = kinematics.jacobian(frame)
        rows = tuple(i for i in range(3) if not J[i, :].is_zero())
        first = _carrier(kinematics, frame)
        q = kinematics.q
        if first is not None:
            fixed = ca.vertcat(*[0 if k == first else q[k] for k in range(q.numel())])
            J = ca.substitute(J, q, fixed)
        J = ca.densify(ca.cse(ca.simplify(J[list(rows), :])))
        depends = ca.which_depends(ca.vec(J @ J.T), q, 1, False)
        joints = tuple(k for k in range(q.numel()) if depends[k])
        if len(rows) > q.numel() or not joints:
            raise RobotError(kinematics.robot.name, "no Jacobian to bound")
        small = ca.SX.sym("q", len(joints))
        where = {k: i for i, k in enumerate(joints)}
        full = [small[where[k]] if k in where else 0 for k in range(q.numel())]
        J = ca.substitute(J, q, ca.vertcat(*full))
        return ReducedArm(small, joints, J, rows, first)


def _carrier(kinematics: Kinematics, frame: str | None) -> int | None:
    """The coordinate of the joint that carries the whole chain, if there is one."""
    robot = kinematics.robot
    chain = sorted(robot.tree.ancestors(robot.frame(frame).joint))
    first = chain[0]
    coordinate = int(robot.tree.source[first])
    alone = all(int(robot.tree.source[k]) != coordinate for k in chain[1:])
    slides = robot.tree.types[first] == PRISMATIC
    unit = abs(float(np.sum(robot.tree.axes[first] ** 2)) - 1.0) < 1e-14
    return coordinate if alone and unit and not slides else None
