"""Streams of QPs: one formulation along a motion."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from rrnn_opt.errors import RrnnError, ShapeError
from rrnn_opt.formulation import Formulation
from rrnn_opt.robot import Kinematics
from rrnn_opt.solving.parts import Array
from rrnn_opt.solving.protocol import Instance


class Motion(Protocol):
    """What a stream is recorded along; a ``Trajectory`` is one."""

    @property
    def q(self) -> Array:
        """Positions, (k, nv), rad or m."""
        ...

    @property
    def qd(self) -> Array:
        """Velocities, (k, nv), rad/s or m/s."""
        ...


@dataclass(frozen=True, eq=False)
class Stream:
    """QPs of one shape, in order.

    Attributes:
        name: for tables.
        instances: parameters and problem of each.
        rows: row of the motion that each was recorded at.
        scales: factor in [0, 1] on that row's velocity.
    """

    name: str
    instances: tuple[Instance, ...]
    rows: tuple[int, ...]
    scales: tuple[float, ...]

    def __len__(self) -> int:
        return len(self.instances)


def record_stream(
    form: Formulation,
    motion: Motion,
    *,
    kinematics: Kinematics,
    frame: str | None = None,
    count: int = 40,
) -> Stream:
    """The programmes that a controller meets along a motion.

    ``q`` is the motion's; ``rd_dot = s J(q) qd`` is the tip's velocity, with
    s <= 1 the largest factor for which s qd is within the formulation's own
    bounds (the bounds (10) are tighter than the limits that a motion is timed
    for).  So u = s qd is feasible, and every programme has a solution.  ``rd``
    is where the motion ends.

    Args:
        form: with parameters among ``q``, ``rd_dot`` and ``rd``.
        motion: anything with rows ``q`` and ``qd``.
        kinematics: of the robot that moves.
        frame: that the formulation speaks of; the tip by default.
        count: at most so many rows, evenly spread, first and last included.

    Returns:
        The stream.

    Raises:
        ShapeError: q or qd has the wrong shape.
        RrnnError: the formulation has another parameter.
    """
    q, qd = _rows(motion.q, motion.qd, kinematics.robot.nv)
    known = {"q", "rd_dot", "rd"}
    unknown = [p.name for p in form.parameters if p.name not in known]
    if unknown:
        raise RrnnError(f"{form.name}: no motion gives parameter '{unknown[0]}'")
    tip = _tip(kinematics, frame)
    end = np.asarray(tip(q[-1], qd[-1])[0]).ravel()
    chosen = np.unique(np.linspace(0, len(q) - 1, min(count, len(q))).round())
    names = {p.name for p in form.parameters}
    instances, scales = [], []
    for k in chosen.astype(int):
        scale = _largest_scale(form, q[k], qd[k], names)
        velocity = np.asarray(tip(q[k], scale * qd[k])[1]).ravel()
        values = {"q": q[k], "rd_dot": velocity, "rd": end}
        given = {name: values[name] for name in values if name in names}
        instances.append(Instance(form.qp.at(**given), given))
        scales.append(scale)
    rows = tuple(int(k) for k in chosen)
    return Stream(form.name, tuple(instances), rows, tuple(scales))


def _rows(q: ArrayLike, qd: ArrayLike, nv: int) -> tuple[Array, Array]:
    q, qd = np.asarray(q, dtype=np.float64), np.asarray(qd, dtype=np.float64)
    if q.ndim != 2 or q.shape[1] != nv or len(q) == 0:
        raise ShapeError("motion.q", (max(len(q), 1), nv), q.shape)
    if qd.shape != q.shape:
        raise ShapeError("motion.qd", q.shape, qd.shape)
    return q, qd


def _tip(kin: Kinematics, frame: str | None) -> ca.Function:
    """Position and velocity of the frame from q and qd."""
    qd = ca.SX.sym("qd", kin.robot.nv)
    velocity = kin.jacobian(frame) @ qd
    return ca.Function("tip", [kin.q, qd], [kin.position(frame), velocity])


def _largest_scale(form: Formulation, q: Array, qd: Array, names: set[str]) -> float:
    """Largest s in [0, 1] with s qd within the bounds at q."""
    probe = {"q": q, "rd_dot": np.zeros(3), "rd": np.zeros(3)}
    problem = form.qp.at(**{name: probe[name] for name in names})
    if problem.lb is None:
        return 1.0
    bound = np.where(qd > 0.0, problem.ub, problem.lb)
    moving = qd != 0.0
    allowed = bound[moving] / qd[moving]
    return float(np.clip(allowed.min(initial=1.0), 0.0, 1.0))
