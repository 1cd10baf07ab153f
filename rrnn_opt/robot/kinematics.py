"""Forward kinematics and geometric Jacobian of a robot, written in CasADi SX."""

from __future__ import annotations

from functools import cached_property

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.errors import RrnnError, ShapeError
from rrnn_opt.robot.robot import Robot
from rrnn_opt.robot.rotation import homogeneous
from rrnn_opt.robot.tree import BASE, PRISMATIC, Frame
from rrnn_opt.robot.tree_frames import Pose, carried, tree_frames

POSITION, POSE = "position", "pose"


class Kinematics:
    """Symbolic kinematics of a robot; every expression is in the symbol ``q``.

        T_k(q) = T_parent(k)(q) P_k exp(v_k a_k),    v_k = m_k q_source(k) + b_k

    with placement P_k, axis a_k (a turn about it, or a shift along it) and the
    mimic coupling m_k, b_k.

    Attributes:
        robot: the robot.
        q: joint coordinates, SX (nv, 1), rad or m.
    """

    @checked()
    def __init__(self, robot: Robot) -> None:
        """Name the coordinates; expressions are built when asked for.

        Args:
            robot: the robot.
        """
        self.robot = robot
        self.q: ca.SX = ca.SX.sym("q", robot.nv)
        self._poses: dict[str, Pose] = {}

    @cached_property
    def _frames(self) -> list[Pose]:
        """(rotation (3, 3), origin (3, 1)) of every joint frame, in the base."""
        return tree_frames(self.robot.tree, self.q)

    @cached_property
    def _axes(self) -> list[ca.SX]:
        """Axis (3, 1) of every joint, in the base."""
        pairs = zip(self._frames, self.robot.tree.axes, strict=True)
        return [R @ ca.SX(axis) for (R, _), axis in pairs]

    def _pose(self, frame: str | None) -> Pose:
        """Rotation and origin of a frame; built once, so that they are shared."""
        where = self.robot.frame(frame)
        if where.name not in self._poses:
            pose = carried(self._frames, where.joint, where.placement)
            self._poses[where.name] = pose
        return self._poses[where.name]

    def joint_frames(self) -> list[ca.SX]:
        """Pose ``T_k`` of every joint's frame after its motion, nj of (4, 4), m."""
        return [homogeneous(R, p) for R, p in self._frames]

    def origins(self) -> ca.SX:
        """Origins ``o_k`` of the joint frames, ``T_k = [R_k o_k; 0 1]``, (3, nj), m."""
        return ca.horzcat(*[p for _, p in self._frames])

    def axes(self) -> ca.SX:
        """Joint axes in the base, unit columns ``z_k = R_k a_k``, (3, nj)."""
        return ca.horzcat(*self._axes)

    def pose(self, frame: str | None = None) -> ca.SX:
        """Pose of a frame in the base, ``T(q) = T_joint(q) placement``, (4, 4), m.

        Args:
            frame: its name; the tip without one.

        Raises:
            RobotError: there is no such frame.
        """
        return homogeneous(*self._pose(frame))

    def position(self, frame: str | None = None) -> ca.SX:
        """Origin r of a frame in the base, ``T(q) = [R r; 0 1]``, (3, 1), m.

        Args:
            frame: its name; the tip without one.

        Raises:
            RobotError: there is no such frame.
        """
        return self._pose(frame)[1]

    def jacobian(self, frame: str | None = None, *, kind: str = POSITION) -> ca.SX:
        """Geometric Jacobian of a frame, ``(v, w) = J(q) qd`` in the base's axes.

            revolute: J_k = (z_k x (p - o_k), z_k),    prismatic: J_k = (z_k, 0)

        with v the velocity of the frame's origin p and w its angular velocity.
        A mimic joint adds its column, times its multiplier, to that of the
        coordinate which drives it.

        Args:
            frame: name of the frame; the tip without a name.
            kind: "position" for the three rows of the linear velocity, m;
                "pose" for six rows, linear then angular.

        Returns:
            SX (3, nv) or (6, nv); linear rows in m/rad (1 where a joint
            slides), angular rows in rad/rad (0 where it slides).

        Raises:
            RobotError: there is no such frame.
            RrnnError: ``kind`` is neither of the two.
        """
        if kind not in (POSITION, POSE):
            raise RrnnError(f"kind must be '{POSITION}' or '{POSE}', not '{kind}'")
        full = self._columns(self.robot.frame(frame), self._pose(frame)[1])
        return full[:3, :] if kind == POSITION else full

    def _columns(self, where: Frame, point: ca.SX) -> ca.SX:
        tree = self.robot.tree
        out = ca.SX.zeros(6, self.robot.nv)
        for k in tree.ancestors(where.joint):
            z, origin = self._axes[k], self._frames[k][1]
            slides = tree.types[k] == PRISMATIC
            linear = z if slides else ca.cross(z, point - origin)
            angular = ca.SX.zeros(3, 1) if slides else z
            column = float(tree.multiplier[k]) * ca.vertcat(linear, angular)
            i = int(tree.source[k])
            out[:, i] = out[:, i] + column
        return out

    def jacobian_dot(
        self, frame: str | None, qd: ca.SX, *, kind: str = POSITION
    ) -> ca.SX:
        """Time derivative of the Jacobian along joint velocities.

            dJ/dt = sum_j (dJ/dq_j) qd_j

        Args:
            frame: name of the frame; None for the tip.
            qd: joint velocities, (nv, 1), rad/s or m/s.
            kind: as in ``jacobian``.

        Returns:
            SX (3, nv) or (6, nv), in units of the Jacobian per second.

        Raises:
            RobotError: there is no such frame.
            ShapeError: ``qd`` is not (nv, 1).
        """
        velocity = ca.SX(qd)
        if velocity.shape != self.q.shape:
            raise ShapeError("qd", self.q.shape, velocity.shape)
        jacobian = self.jacobian(frame, kind=kind)
        flat = ca.jtimes(ca.vec(jacobian), self.q, velocity)
        return ca.densify(ca.reshape(flat, *jacobian.shape))

    def sphere_centres(self) -> ca.SX:
        """Centres of the collision spheres in the base, ``o + R c``, (3, ns), m."""
        centres = []
        for sphere in self.robot.spheres:
            centre = ca.SX(sphere.center)
            if sphere.joint != BASE:
                R, p = self._frames[sphere.joint]
                centre = p + R @ centre
            centres.append(centre)
        return ca.horzcat(*centres) if centres else ca.SX.zeros(3, 0)

    def manipulability(self, frame: str | None = None) -> ca.SX:
        """Yoshikawa's measure of the position Jacobian.

            w = sqrt(det(J J'))

        Rows in which the arm cannot move at all (z of a planar arm) are left
        out; with fewer joints than rows it is sqrt(det(J' J)).

        Args:
            frame: its name; the tip without one.

        Returns:
            w, a scalar SX, m3 for three rows of revolute joints, m2 for two.

        Raises:
            RobotError: there is no such frame.

        Source:
            T. Yoshikawa, Int. J. Robotics Research 4(2), 1985.  Leaving out
            rows, and J'J for few joints, are ours.
        """
        jacobian = self.jacobian(frame)
        rows = [i for i in range(3) if not jacobian[i, :].is_zero()]
        moving = jacobian[rows, :]
        wide = moving.shape[0] <= moving.shape[1]
        return ca.sqrt(ca.det(moving @ moving.T if wide else moving.T @ moving))

    def functions(self) -> dict[str, ca.Function]:
        """CasADi functions of ``q``, by name, for the tip.

        Returns:
            "pose", "position", "jacobian", "pose_jacobian", "jacobian_dot"
            (of q and qd), "joint_origins", "joint_axes", "sphere_centres".
        """
        qd = ca.SX.sym("qd", self.robot.nv)
        parts = {
            "pose": self.pose(),
            "position": self.position(),
            "jacobian": self.jacobian(),
            "pose_jacobian": self.jacobian(kind=POSE),
            "joint_origins": self.origins(),
            "joint_axes": self.axes(),
            "sphere_centres": self.sphere_centres(),
        }
        out = {
            name: ca.Function(name, [self.q], [value], ["q"], ["value"])
            for name, value in parts.items()
        }
        out["jacobian_dot"] = ca.Function(
            "jacobian_dot",
            [self.q, qd],
            [self.jacobian_dot(None, qd)],
            ["q", "qd"],
            ["value"],
        )
        return out
