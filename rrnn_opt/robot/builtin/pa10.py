"""The Mitsubishi PA10-7C, seven joints S-R-S without lateral offsets.

    p(q) = d1 z + Rz(q1) Ry(q2) (d3 z + Rz(q3) Ry(q4) (d5 z + Rz(q5) Ry(q6) d7 z))

All placements are shifts along z, so every rotation entry is 0 or 1 exactly.
"""

from __future__ import annotations

import math

import numpy as np

from rrnn_opt.robot.builtin.parts import chain, frame, inflations, limits, spheres
from rrnn_opt.robot.cover import cover_capsule
from rrnn_opt.robot.data import RobotData
from rrnn_opt.robot.placement import shift

BASE_SHOULDER, UPPER_ARM, FOREARM, WRIST_FLANGE = 0.317, 0.45, 0.48, 0.07  # m
JOINTS = ("S1", "S2", "S3", "E1", "E2", "W1", "W2")
RANGE_DEG = (177.0, 94.0, 174.0, 137.0, 255.0, 165.0, 360.0)  # plus and minus
VELOCITY = (1.0, 1.0, 2.0, 2.0, 2 * math.pi, 2 * math.pi, 2 * math.pi)  # rad/s
ACCELERATION = 5.0  # rad/s2, chosen by us

CAPSULES = (  # link, joint, ends along the joint frame's z, radius; m
    ("base_column", 0, 0.08, 0.317, 0.09),
    ("upper_arm", 2, 0.0, 0.45, 0.075),
    ("forearm", 4, 0.0, 0.48, 0.06),
    ("wrist_tool", 6, 0.0, 0.07, 0.045),
)
SELF_PAIRS = (
    ("base_column", "forearm"),
    ("base_column", "wrist_tool"),
    ("upper_arm", "wrist_tool"),
)
SOURCE = (
    "lengths and position limits: public descriptions of the PA10-7C (mlogoth/PA10,"
    " OpenBionics, choreonoid); velocities: the maker's nominal figures; acceleration"
    " 5 rad/s2 and the four capsules: chosen by us"
)


def robot() -> RobotData:
    """The arm, its links as four capsules covered by spheres."""
    rise = (0.0, BASE_SHOULDER, 0.0, UPPER_ARM, 0.0, FOREARM, 0.0)
    turns = [(0, 0, 1), (0, 1, 0)] * 3 + [(0, 0, 1)]
    covers = [
        cover_capsule((0, 0, low), (0, 0, high), radius=radius, inflation=2e-3)
        for _, _, low, high, radius in CAPSULES
    ]
    bounds = np.radians(RANGE_DEG)
    return RobotData(
        name="pa10",
        joint_names=JOINTS,
        tree=chain([shift(0.0, 0.0, z) for z in rise], turns),
        limits=limits(-bounds, bounds, VELOCITY, [ACCELERATION] * 7),
        frames=(
            frame("base", -1, np.eye(4)),
            frame("shoulder", 1, np.eye(4)),
            frame("elbow", 3, np.eye(4)),
            frame("wrist", 5, np.eye(4)),
            frame("flange", 6, shift(0.0, 0.0, WRIST_FLANGE)),
        ),
        tip="flange",
        spheres=tuple(
            sphere
            for (link, joint, *_), cover in zip(CAPSULES, covers, strict=True)
            for sphere in spheres(link, joint, cover)
        ),
        self_pairs=SELF_PAIRS,
        cover=inflations(covers),
        source=SOURCE,
        licence="Apache-2.0",
    )
