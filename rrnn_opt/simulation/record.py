"""What a compiled loop is given, and what it writes."""

from __future__ import annotations

from dataclasses import dataclass

from rrnn_opt.simulation.task import Array


@dataclass(frozen=True)
class Pace:
    """How the loop goes.

    Attributes:
        dt: control period, s.
        kappa: gain of the position feedback added to rd_dot, 1/s.
        h: Euler step of the network, s.
        most: network steps a period, at most.
        tolerance: residual at which the network counts as settled; negative:
            it always makes ``most`` steps.
    """

    dt: float
    kappa: float
    h: float
    most: int
    tolerance: float


@dataclass(frozen=True, eq=False)
class Inputs:
    """What a run is given, one row a control period.

    Attributes:
        rd: (rows, 3), m.
        rd_dot: (rows, 3), m/s.
        rd_ddot: (rows, 3), m/s2.
        velocity_noise: (rows, nv), rad/s or m/s.
        acceleration_noise: (rows, nv), rad/s2 or m/s2.
    """

    rd: Array
    rd_dot: Array
    rd_ddot: Array
    velocity_noise: Array
    acceleration_noise: Array


@dataclass(frozen=True, eq=False)
class Record:
    """What the loop wrote, one row a control period.

    Attributes:
        q: positions, (rows, nv), rad or m.
        command: joint quantity commanded, (rows, nv): velocity, acceleration
            or increment, by the scheme's level.
        velocity: velocity without the noise on it, (rows, nv), rad/s or m/s.
        qd: velocity done, noise included, (rows, nv).
        tip: position of the frame, (rows, 3), m.
        network_steps: steps of the network in all.
        unsettled: periods that ended above the tolerance, if there is one.
    """

    q: Array
    command: Array
    velocity: Array
    qd: Array
    tip: Array
    network_steps: int
    unsettled: int
