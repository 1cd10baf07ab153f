"""What a task is made of: a curve for the tip, control settings and noise."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.arguments import checked

Array = NDArray[np.float64]

KINDS = ("circle", "figure8", "line", "point")
PLANES = {"xy": (0, 1), "yx": (1, 0), "yz": (1, 2), "zy": (2, 1)}
PLANES |= {"zx": (2, 0), "xz": (0, 2)}
PROFILES = ("smooth", "uniform")
ENTRANCES = ("joint_velocity", "task_velocity", "acceleration")
LAWS = ("reduced", "literal")


@checked()
@dataclass(frozen=True, eq=False)
class Curve:
    """Where the tip should be; phi(t) runs from 0 to 2 pi in one period.

    Attributes:
        kind: "circle", "figure8", "line" or "point".
        period: T, s.
        duration: of the run, s.
        profile: "smooth", phi = 2 pi sin^2(pi t / 2T), which starts and ends at
            rest and runs back in the second period, or "uniform", 2 pi t / T.
        plane: first and second axis of a circle or figure8, e.g. "yz".
        radius: of the circle; half the length of the figure8, m.
        centre: (3,), m; None puts the curve through the tip's start.
        offset: (3,), m, from the start to the line's end or to the point.
        position: (3,), m, the line's end or the point; instead of ``offset``.
    """

    kind: str
    period: float
    duration: float
    profile: str = "smooth"
    plane: str = "yz"
    radius: float = 0.0
    centre: Array | None = None
    offset: Array | None = None
    position: Array | None = None


@checked()
@dataclass(frozen=True)
class Control:
    """How the scheme is run.

    Attributes:
        dt: control period, s.
        epsilon: time constant of the network, s.
        kappa: gain of the position feedback that is added to rd_dot, 1/s.
        law: "reduced": the network settles within each control period; or
            "literal": it runs in time, its state carried from step to step.
        steps: network steps a control period; None chooses (see ``simulate``).
    """

    dt: float = 0.01
    epsilon: float = 0.01
    kappa: float = 0.0
    law: str = "reduced"
    steps: int | None = None


@checked()
@dataclass(frozen=True)
class Noise:
    """White Gaussian noise, one draw a control step, held for that step.

    Attributes:
        enters: "joint_velocity": added to the joint velocity, rad/s;
            "task_velocity": added to the rd_dot that the scheme is told, m/s,
            and its difference quotient to the rd_ddot;
            "acceleration": added to the joint acceleration, rad/s2; for a
            scheme of velocities its sum times dt is added to the velocity.
        sigma: standard deviation, in the unit of what it enters.
        seed: of the generator.
    """

    enters: str = "joint_velocity"
    sigma: float = 0.0
    seed: int = 0
