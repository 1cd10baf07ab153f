"""Symbols and Jacobian of a tracking task, shared by the schemes."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol, require_shape

POSITION, POSE = "position", "pose"
_ROWS = {POSITION: 3, POSE: 6}
_UNITS = {POSITION: "m", POSE: "m, rad"}


@dataclass(frozen=True, eq=False)
class Task:
    """What a frame is asked to do.

    Attributes:
        q: joint positions, the symbol of the kinematics, (nv, 1).
        jacobian: J, (m, nv); rows linear then angular, in base axes.
        rate: ``rd_dot``, desired velocity of the frame, (m, 1).
        kind: "position" (m = 3) or "pose" (m = 6).
    """

    q: Symbol
    jacobian: ca.SX
    rate: Symbol
    kind: str

    @property
    def size(self) -> int:
        """Number of rows, m."""
        return _ROWS[self.kind]

    @property
    def moving(self) -> int:
        """Rows in which the arm can move at all: a planar one has no z."""
        rows = range(self.size)
        return sum(not self.jacobian[i, :].is_zero() for i in rows)


def tracking(kin: Kinematics, frame: str | None, kind: str = POSITION) -> Task:
    """The task of following a velocity.

    Args:
        kin: kinematics of the robot.
        frame: the frame that follows; None for the tip.
        kind: "position" or "pose".

    Raises:
        RrnnError: ``kind`` is neither.
        RobotError: there is no such frame.
    """
    if kind not in _ROWS:
        raise RrnnError(f"task '{kind}': use '{POSITION}' or '{POSE}'")
    rows, nv = _ROWS[kind], kin.robot.nv
    J = kin.jacobian(frame, kind=kind)
    require_shape(J, (rows, nv), "Jacobian")
    unit = ", ".join(f"{u}/s" for u in _UNITS[kind].split(", "))
    rate = Symbol.vector("rd_dot", rows, unit, "desired velocity of the frame")
    return Task(positions(kin), J, rate, kind)


def positions(kin: Kinematics) -> Symbol:
    """``q``, the joint positions."""
    return Symbol("q", kin.q, "rad or m", "joint positions")


def velocity(kin: Kinematics) -> Symbol:
    """``u``, the joint velocity as a decision."""
    return Symbol.vector("u", kin.robot.nv, "rad/s or m/s", "joint velocity")


def target() -> Symbol:
    """``rd``, the target position of a frame."""
    return Symbol.vector("rd", 3, "m", "target position of the frame")


def require_positive(**numbers: float) -> None:
    """Refuse a setting that is not positive and finite.

    Raises:
        RrnnError: names the first one.
    """
    for name, value in numbers.items():
        if not 0.0 < value < float("inf"):
            raise RrnnError(f"{name} {value}: it must be positive and finite")


def require_not_negative(**numbers: float) -> None:
    """Refuse a setting that is negative or not finite.

    Raises:
        RrnnError: names the first one.
    """
    for name, value in numbers.items():
        if not 0.0 <= value < float("inf"):
            raise RrnnError(f"{name} {value}: it must be finite and not negative")


def follow(
    kin: Kinematics,
    task: Task,
    *,
    name: str,
    wish: ca.SX,
    parameters: tuple[Symbol, ...] = (),
    bounds: tuple[ca.SX, ca.SX] | None = None,
    citation: str,
    notes: str,
) -> Formulation:
    """Follow the task exactly, and a wish in what self-motion is left.

        minimise    1/2 u'u - wish'u   ( = 1/2 |u - wish|^2 + constant )
        subject to  rd_dot - J u = 0,    bounds

    Without active bounds its optimum is ``J# rd_dot + (I - J# J) wish``.

    Args:
        kin: kinematics of the robot.
        task: what is followed.
        name: of the scheme.
        wish: joint velocity that would be liked, (nv, 1), rad/s or m/s.
        parameters: symbols of the wish besides q.
        bounds: of u, if any.
        citation: of the scheme.
        notes: of the scheme.
    """
    u = velocity(kin)
    lower, upper = bounds if bounds is not None else (None, None)
    return Formulation(
        name=name,
        decision=u,
        parameters=(task.q, task.rate, *parameters),
        cost=ca.dot(u.sx, u.sx) / 2 - ca.dot(wish, u.sx),
        equalities=task.rate.sx - task.jacobian @ u.sx,
        lower=lower,
        upper=upper,
        citation=citation,
        notes=notes,
    )


def acceleration(kin: Kinematics) -> Symbol:
    """``u``, the joint acceleration as a decision."""
    return Symbol.vector("u", kin.robot.nv, "rad/s2 or m/s2", "joint acceleration")


def joint_velocity(kin: Kinematics) -> Symbol:
    """``qd``, the joint velocity as a parameter."""
    return Symbol.vector("qd", kin.robot.nv, "rad/s or m/s", "joint velocity")


def target_acceleration() -> Symbol:
    """``rd_ddot``, the desired acceleration of a frame."""
    meaning = "desired acceleration of the frame"
    return Symbol.vector("rd_ddot", 3, "m/s2", meaning)


def regulation_cost(
    kin: Kinematics, u: Symbol, rd: Symbol, *, frame: str | None, epsilon: float
) -> ca.SX:
    """``1/2 u'u - (1/epsilon) (rd - r(q))'J(q) u``, the cost of (17); (1, 1)."""
    require_positive(epsilon=epsilon)
    error = (rd.sx - kin.position(frame)) / epsilon
    return ca.dot(u.sx, u.sx) / 2 - ca.dot(kin.jacobian(frame).T @ error, u.sx)
