"""Valid documents that mutations start from."""

from __future__ import annotations

import functools
import json
import struct
from pathlib import Path
from typing import Any

DATA = Path(__file__).parent / "data"

URDF = """<?xml version="1.0"?>
<robot name="arm">
  <link name="base"><collision><geometry><box size="0.2 0.2 0.1"/></geometry>
  </collision></link>
  <link name="upper"><collision><origin xyz="0.2 0 0" rpy="0 1.57 0"/><geometry>
    <cylinder radius="0.05" length="0.4"/></geometry></collision></link>
  <link name="lower"><collision><geometry><sphere radius="0.06"/></geometry>
  </collision></link>
  <link name="hand"/>
  <link name="finger"/>
  <joint name="j1" type="revolute"><parent link="base"/><child link="upper"/>
    <origin xyz="0 0 0.1" rpy="0 0 0"/><axis xyz="0 0 1"/>
    <limit lower="-2" upper="2" velocity="1" effort="1"/></joint>
  <joint name="j2" type="continuous"><parent link="upper"/><child link="lower"/>
    <origin xyz="0.4 0 0"/><axis xyz="0 1 0"/></joint>
  <joint name="j3" type="prismatic"><parent link="lower"/><child link="hand"/>
    <origin xyz="0.1 0 0"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="0.2" velocity="0.1" effort="1"/></joint>
  <joint name="grip" type="revolute"><parent link="hand"/><child link="finger"/>
    <axis xyz="0 0 1"/><limit lower="-1" upper="1" velocity="1" effort="1"/>
    <mimic joint="j1" multiplier="0.5" offset="0.1"/></joint>
</robot>
"""
SPHERES: dict[str, Any] = {
    "links": {
        "base": [{"center": [0.0, 0.0, 0.0], "radius": 0.1}],
        "upper": [{"center": [0.2, 0.0, 0.0], "radius": 0.06}],
        "lower": [{"center": [0.0, 0.0, 0.0], "radius": 0.06}],
        "finger": [{"center": [0.0, 0.1, 0.0], "radius": 0.02}],
    },
    "disabled_self_collision_pairs": [["base", "upper", "adjacent"]],
}
TASK = """[task]
kind = "circle"
radius = 0.05
plane = "xy"
through = "start"
period = 2.0
duration = 0.2
profile = "smooth"

[robot]
q0 = [0.3, 0.5, 0.7]
frame = "tip"

[control]
dt = 0.01
epsilon = 0.01
kappa = 4.0

[noise]
enters = "joint_velocity"
sigma = 0.001
seed = 3

[[scene.obstacles]]
type = "sphere"
radius = 0.1
position = [3.0, 3.0, 0.0]
"""
OBSTACLES: list[dict[str, Any]] = [
    {"name": "b", "type": "box", "size": [0.1, 0.2, 0.3], "position": [3.0, 0, 0]},
    {
        "type": "cylinder",
        "radius": 0.1,
        "length": 0.5,
        "position": [0, 3, 0],
        "quat_xyzw": [0, 0, 0, 1],
    },
    {"type": "capsule", "radius": 0.1, "length": 0.5, "position": [0, -3, 0.0]},
    {"type": "sphere", "radius": 0.1, "position": [-3.0, 0, 0]},
    {"type": "halfspace", "normal": [0, 0, 1.0], "offset": -2.0},
]
PROBLEM: dict[str, Any] = {
    "name": "three joints",
    "robot": "planar3",
    "frame": "tip",
    "start": [0.1, 0.2, 0.3],
    "goal": [
        {"joints": [0.5, 0.5, 0.5]},
        {"position": [1.0, 1.0, 0.0], "tolerance": 0.01},
        {
            "position": [1.0, 1.2, 0.0],
            "quat_xyzw": [0, 0, 0, 1],
            "angle_tolerance": 0.1,
            "free_axis": "z",
            "region": {"box": [0.1, 0.1, 0.1]},
        },
    ],
    "obstacles": OBSTACLES,
    "attached": [
        {"frame": "tip", "type": "box", "size": [0.1, 0.1, 0.1], "position": [0, 0, 0]}
    ],
    "margin": 0.01,
}
URDF_PROBLEM: dict[str, Any] = {
    "robot": "arm.urdf",
    "frame": "hand",
    "spheres": "spheres.json",
    "locked": {},
    "start": [0.1, 0.2, 0.1],
    "goal": {"joints": [0.5, 0.5, 0.15]},
    "obstacles": [
        {"type": "mesh", "path": "hull.stl", "scale": 1.0, "position": [3.0, 0, 0]},
        {"type": "points", "path": "cloud.csv", "radius": 0.01},
    ],
}
CORNERS = ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))
FACES = ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))
OBJ = "".join(f"v {x} {y} {z}\n" for x, y, z in CORNERS) + "".join(
    f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in FACES
)
ASCII_STL = (
    "solid s\n"
    + "".join(
        "facet normal 0 0 0\nouter loop\n"
        + "".join("vertex {} {} {}\n".format(*CORNERS[i]) for i in face)
        + "endloop\nendfacet\n"
        for face in FACES
    )
    + "endsolid s\n"
)
CSV = "x,y,z\n0,0,3\n0.1,0,3\n0,0.25,3\n"


def binary_stl() -> bytes:
    """A tetrahedron as binary STL."""
    body = b"".join(
        struct.pack("<12fH", 0, 0, 0, *(float(x) for i in f for x in CORNERS[i]), 0)
        for f in FACES
    )
    return b"\0" * 80 + struct.pack("<I", len(FACES)) + body


def lay_out(folder: Path) -> None:
    """The files that ``URDF_PROBLEM`` names."""
    (folder / "arm.urdf").write_text(URDF, encoding="utf-8")
    (folder / "spheres.json").write_text(json.dumps(SPHERES), encoding="utf-8")
    (folder / "hull.stl").write_bytes(binary_stl())
    (folder / "cloud.csv").write_text(CSV, encoding="utf-8")


@functools.cache
def certificates() -> dict[str, dict[str, Any]]:
    """Certificates of claims by id, of every method."""
    text = (DATA / "certificates.json").read_text(encoding="utf-8")
    found: dict[str, dict[str, Any]] = json.loads(text)
    return found


@functools.cache
def plan_text() -> str:
    """A plan document of three joints among one obstacle of each kind."""
    from rrnn_opt.planning import Problem, plan

    problem = Problem.from_dict({**PROBLEM, "goal": PROBLEM["goal"][0]})
    return json.dumps(plan(problem, seed=0, max_explorations=200).to_dict())
