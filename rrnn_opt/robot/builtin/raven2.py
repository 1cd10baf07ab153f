"""The Raven II surgical arm (left), six joints about a remote centre.

Modified Denavit-Hartenberg, T = Rx(alpha) Tx(a) Rz(theta) Tz(d), base frame at
the remote centre, no cable coupling.  The tool points along minus z of the
insertion joint: the wrist lies 0.47 m - insertion beyond the remote centre.
"""

from __future__ import annotations

import math

import numpy as np

from rrnn_opt.robot.builtin.parts import chain, frame, inflations, limits, spheres
from rrnn_opt.robot.cover import cover_capsule
from rrnn_opt.robot.data import RobotData
from rrnn_opt.robot.placement import compose, shift, turn
from rrnn_opt.robot.tree import PRISMATIC, REVOLUTE, Array

SHAFT, WRIST = 0.47, 0.013  # m: -d4, and from the wrist to the grasper's axis
RADIUS = 0.005  # m, of shaft and wrist, chosen by us

JOINTS = ("shoulder", "elbow", "insertion", "roll", "wrist", "grasper")
DH = (  # alpha (deg), a (m), theta at joint value zero (deg), d at zero (m)
    (0.0, 0.0, 205.0, 0.0),
    (75.0, 0.0, 180.0, 0.0),
    (180.0 - 52.0, 0.0, 90.0, 0.0),
    (0.0, 0.0, 0.0, -SHAFT),
    (90.0, 0.0, -90.0, 0.0),
    (90.0, WRIST, 0.0, 0.0),
)
LOWER_DEG = (0.0, 45.0, 0.0, -182.0, -75.0, -85.0)
UPPER_DEG = (90.0, 135.0, 0.0, 182.0, 75.0, 85.0)
INSERTION = (0.23, 0.56)  # m
SOURCE = (
    "Denavit-Hartenberg numbers, position limits, 3 rad/s and 1 rad/s2: the public"
    " Raven II control software (uw-biorobotics/raven2) and UWEETR-2012-0006;"
    " insertion 0.2 m/s and 1 m/s2, and shaft and wrist as capsules of radius 5 mm:"
    " chosen by us; the jaws have no collision body"
)


def _placement(alpha: float, a: float, theta: float, d: float) -> Array:
    return compose(
        turn("x", alpha), shift(a, 0.0, 0.0), turn("z", theta), shift(0.0, 0.0, d)
    )


def _bounds(degrees: tuple[float, ...], insertion: float) -> list[float]:
    values = [math.radians(value) for value in degrees]
    values[2] = insertion
    return values


def robot() -> RobotData:
    """The left arm; its instrument's shaft and wrist as covered capsules."""
    kinds = [REVOLUTE] * 6
    kinds[2] = PRISMATIC
    shaft = cover_capsule((0, 0, 0), (0, 0, -SHAFT), radius=RADIUS, inflation=2.5e-3)
    wrist = cover_capsule((0, 0, 0), (WRIST, 0, 0), radius=RADIUS, inflation=2.5e-3)
    return RobotData(
        name="raven2",
        joint_names=JOINTS,
        tree=chain([_placement(*row) for row in DH], [(0, 0, 1)] * 6, kinds),
        limits=limits(
            _bounds(LOWER_DEG, INSERTION[0]),
            _bounds(UPPER_DEG, INSERTION[1]),
            [3.0, 3.0, 0.2, 3.0, 3.0, 3.0],
            [1.0] * 6,
        ),
        frames=(
            frame("base", -1, np.eye(4)),
            frame("shaft_end", 3, np.eye(4)),
            frame("wrist_pitch", 4, np.eye(4)),
            frame("wrist", 5, np.eye(4)),
        ),
        tip="wrist",
        spheres=(*spheres("shaft", 2, shaft), *spheres("wrist", 4, wrist)),
        self_pairs=(),
        cover=inflations((shaft, wrist)),
        source=SOURCE,
        licence="Apache-2.0 (our own description of published numbers)",
    )
