"""A planar arm with three joints, for tests, pictures and exact algebra."""

from __future__ import annotations

import numpy as np

from rrnn_opt.robot.builtin.parts import chain, frame, inflations, limits, spheres
from rrnn_opt.robot.cover import Cover, cover_capsule
from rrnn_opt.robot.data import RobotData
from rrnn_opt.robot.placement import shift

LENGTHS = (1.0, 0.8, 0.6)  # m
RADIUS, SPHERE = 0.04, 0.05  # m: links as capsules, spheres that contain them


def _cover(length: float) -> Cover:
    cover = cover_capsule(
        (0, 0, 0), (length, 0, 0), radius=RADIUS, inflation=SPHERE - RADIUS
    )
    return Cover(cover.centers, SPHERE, SPHERE - RADIUS)


def robot() -> RobotData:
    """Links of 1.0, 0.8 and 0.6 m along x that turn about z."""
    covers = [_cover(length) for length in LENGTHS]
    ends = [shift(length, 0.0, 0.0) for length in LENGTHS]
    names = ("link1", "link2", "link3")
    return RobotData(
        name="planar3",
        joint_names=("joint1", "joint2", "joint3"),
        tree=chain([np.eye(4), *ends[:2]], [(0, 0, 1)] * 3),
        limits=limits([-2.9] * 3, [2.9] * 3, [2.0] * 3, [10.0] * 3),
        frames=(
            frame("base", -1, np.eye(4)),
            *(frame(name, k, np.eye(4)) for k, name in enumerate(names)),
            frame("tip", 2, ends[2]),
        ),
        tip="tip",
        spheres=tuple(
            sphere
            for k, (name, cover) in enumerate(zip(names, covers, strict=True))
            for sphere in spheres(name, k, cover)
        ),
        self_pairs=(("link1", "link3"),),
        cover=inflations(covers),
        source="chosen by us: lengths, limits, links as capsules of radius 0.04 m",
        licence="Apache-2.0",
    )
