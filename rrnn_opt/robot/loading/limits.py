"""Limits of a loaded robot: those that the model states, and defaults for the others.

URDF has no acceleration limits, and some files lack velocity limits.  Known
joints take theirs from ``ACCELERATION``; for all others the stated defaults
stand, and ``assumed`` says for which joints.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from rrnn_opt.robot.data import RobotData
from rrnn_opt.robot.tree import (
    CONTINUOUS,
    PRISMATIC,
    REVOLUTE,
    Limits,
    frozen,
)

VELOCITY_DEFAULT = {REVOLUTE: 1.0, CONTINUOUS: 1.0, PRISMATIC: 0.1}  # rad/s, m/s

VELOCITY_CREDIBLE = 100.0  # rad/s or m/s; a larger figure is a placeholder

ACCELERATION_DEFAULT = {REVOLUTE: 5.0, CONTINUOUS: 5.0, PRISMATIC: 1.0}  # rad/s2, m/s2

ACCELERATION = {  # rad/s2; Franka's FCI limits of the Panda
    f"panda_joint{i + 1}": value
    for i, value in enumerate((15.0, 7.5, 10.0, 12.5, 15.0, 20.0, 20.0))
}


def stated_limits(model: Any, types: tuple[str, ...]) -> Limits:
    """Limits of all joints of a model.

    Args:
        model: a ``pin.Model``.
        types: of its joints, in order.
    """
    n = len(types)
    lower, upper = np.full(n, -np.inf), np.full(n, np.inf)
    velocity, acceleration = np.zeros(n), np.zeros(n)
    for i, kind in enumerate(types):
        joint = model.joints[i + 1]
        if kind != CONTINUOUS:
            lower[i] = model.lowerPositionLimit[joint.idx_q]
            upper[i] = model.upperPositionLimit[joint.idx_q]
        given = float(model.velocityLimit[joint.idx_v])
        velocity[i] = given if _credible(given) else VELOCITY_DEFAULT[kind]
        known = ACCELERATION.get(model.names[i + 1])
        acceleration[i] = ACCELERATION_DEFAULT[kind] if known is None else known
    bounds = (lower, upper, velocity, acceleration)
    return Limits(*(frozen(bound, (n,), "limits") for bound in bounds))


def _credible(velocity: float) -> bool:
    return 0.0 < velocity <= VELOCITY_CREDIBLE


def assumed(model: Any, robot: RobotData) -> str:
    """Which limits of a robot's joints are defaults of ours, as a sentence."""
    indices = {name: model.getJointId(name) for name in robot.joint_names}
    speeds = {n: model.velocityLimit[model.joints[i].idx_v] for n, i in indices.items()}
    slow = [name for name, speed in speeds.items() if not _credible(float(speed))]
    rates = [name for name in indices if name not in ACCELERATION]
    parts = [
        f"velocity limit 1 rad/s (0.1 m/s) assumed for {', '.join(slow)}",
        f"acceleration limit 5 rad/s2 (1 m/s2) assumed for {', '.join(rates)}",
    ]
    stated = [part for part, names in zip(parts, (slow, rates), strict=True) if names]
    return "".join(f"; {part}" for part in stated)
