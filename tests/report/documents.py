"""Plan results made by hand: the form of the contract without a planner."""

from __future__ import annotations

import copy
from itertools import pairwise

import numpy as np

TURN = np.pi / 2
LENGTHS = (0.317, 0.0, 0.45, 0.0, 0.48, 0.0)
TWISTS = (-TURN, TURN, -TURN, TURN, -TURN, TURN)
CAPSULES = (
    ("base_column", 0, 0.08, 0.317, 0.09),
    ("upper_arm", 2, 0.0, 0.45, 0.075),
    ("forearm", 4, 0.0, 0.48, 0.06),
    ("wrist_tool", 6, 0.0, 0.07, 0.045),
)
WALL = (
    ("below", (0.02, 3.0, 1.35), (0.42, 0.0, -0.325)),
    ("above", (0.02, 3.0, 1.35), (0.42, 0.0, 1.325)),
    ("left", (0.02, 1.35, 0.3), (0.42, 0.825, 0.5)),
    ("right", (0.02, 1.35, 0.3), (0.42, -0.825, 0.5)),
)
START = (0.712, 0.470, -1.618, 2.383, -3.881, -2.729, -1.815)
THROUGH = (-0.10, 0.30, -0.25, 2.15, -1.2, -1.10, -1.0)
END = (0.290, 0.716, -0.393, 1.492, -0.354, -1.833, 3.277)
CERTIFICATE = {
    "collision_free": "PROVED",
    "limits": "PROVED",
    "clearance_lower_bound": 0.0021,
    "goal_error": 2e-4,
    "goal_angle_error": None,
    "method": "subdivision",
    "checks": 1234,
    "time_s": 0.05,
}
STATS = {
    "explorations": 9,
    "random": 4,
    "heuristic": 5,
    "nodes": 21,
    "rollout_steps": 800,
    "time_s": 0.06,
}


def _placement(length: float, twist: float) -> list[list[float]]:
    c, s = np.cos(twist), np.sin(twist)
    return [[1, 0, 0, 0], [0, c, -s, 0], [0, s, c, length], [0, 0, 0, 1]]


def _limits(nv: int) -> dict[str, list[float]]:
    return {
        "lower": [-3.0] * nv,
        "upper": [3.0] * nv,
        "velocity": [1.0, 1.0, 2.0, 2.0, 6.28, 6.28, 6.28][:nv],
        "acceleration": [5.0] * nv,
    }


def _coupling(nj: int) -> dict[str, list[float]]:
    return {
        "source": list(range(nj)),
        "multiplier": [1.0] * nj,
        "offset": [0.0] * nj,
    }


def pa10() -> dict:
    """Robot block of a PA10-like arm."""
    spheres = [
        {"link": link, "joint": joint, "center": [0.0, 0.0, z], "radius": 1.06 * r}
        for link, joint, low, high, r in CAPSULES
        for z in np.linspace(low, high, 2 + int((high - low) / 0.06))
    ]
    eye = np.eye(4).tolist()
    tip = {"name": "flange", "joint": 6, "placement": _placement(0.07, 0.0)}
    return {
        "name": "pa10",
        "parents": list(range(-1, 6)),
        "placements": [eye, *map(_placement, LENGTHS, TWISTS)],
        "axes": [[0.0, 0.0, 1.0]] * 7,
        "types": ["revolute"] * 7,
        "coupling": _coupling(7),
        "joint_names": [f"joint{k + 1}" for k in range(7)],
        "tip": tip,
        "spheres": spheres,
        "self_pairs": [["base_column", "forearm"]],
        "limits": _limits(7),
    }


def planar() -> dict:
    """Robot block of a planar arm with a prismatic last joint."""
    moved = [np.eye(4) for _ in range(3)]
    moved[1][0, 3], moved[2][0, 3] = 1.0, 0.8
    end = np.eye(4)
    end[0, 3] = 0.6
    return {
        **pa10(),
        "name": "planar",
        "parents": [-1, 0, 1],
        "placements": [m.tolist() for m in moved],
        "axes": [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
        "types": ["revolute", "continuous", "prismatic"],
        "coupling": _coupling(3),
        "joint_names": ["a", "b", "c"],
        "tip": {"name": "tip", "joint": 2, "placement": end.tolist()},
        "spheres": [],
        "self_pairs": [],
        "limits": {
            "lower": [-3.0, None, -0.2],
            "upper": [3.0, None, 0.2],
            "velocity": [2.0] * 3,
            "acceleration": [10.0] * 3,
        },
    }


def timed(postures: list, *, piece: float = 1.0, rows: int = 12) -> dict:
    """A motion through postures that rests at each, as Hermite rows."""
    points = np.asarray(postures, dtype=float)
    t, q, qd = [], [], []
    for k, (a, b) in enumerate(pairwise(points)):
        for s in np.linspace(0.0, 1.0, rows)[(1 if k else 0) :]:
            t.append(piece * (k + s))
            q.append((a + (3 * s**2 - 2 * s**3) * (b - a)).tolist())
            qd.append(((6 * s - 6 * s**2) / piece * (b - a)).tolist())
    return {
        "t": t,
        "q": q,
        "qd": qd,
        "qdd": np.zeros_like(q).tolist(),
        "duration": t[-1],
    }


def window() -> dict:
    """A PA10 that reaches through a window."""
    cell = np.concatenate([[0.0], 0.8 * (1 - np.exp(-0.5 * np.arange(1, 9)))])
    obstacles = [
        {"name": n, "type": "box", "size": list(s), "position": list(p)}
        for n, s, p in WALL
    ]
    return {
        "status": "solved",
        "message": "found and proved",
        "path": [list(START), list(THROUGH), list(END)],
        "trajectory": timed([START, THROUGH, END], piece=2.0),
        "certificate": dict(CERTIFICATE),
        "stats": {**STATS, "memory_cell": cell.tolist()},
        "problem": {
            "robot": "pa10",
            "start": list(START),
            "goal": {"position": [0.7, 0.05, 0.45], "tolerance": 0.001},
            "obstacles": obstacles,
            "margin": 0.0,
        },
        "robot": pa10(),
        "seed": 0,
        "planner": "random-rnn",
        "versions": {"rrnn_opt": "0.1.0"},
    }


TURNED = [0.0, 0.0, np.sin(0.4), np.cos(0.4)]
SHAPES = [
    {"name": "box", "type": "box", "size": [0.3, 0.2, 0.5], "position": [1, 1, 0]},
    {"name": "can", "type": "cylinder", "radius": 0.1, "length": 0.5}
    | {"position": [-0.5, 1, 0], "quat_xyzw": TURNED},
    {"name": "pill", "type": "capsule", "radius": 0.1, "length": 0.4}
    | {"position": [0.3, 1.4, 0]},
    {"name": "ball", "type": "sphere", "radius": 0.2, "position": [1.8, 1, 0.1]},
    {"name": "floor", "type": "halfspace", "normal": [0, 0, 1], "offset": -0.4},
    {"name": "blob", "type": "mesh", "path": "blob.stl"},
]


def every_shape() -> dict:
    """A planar arm among one obstacle of each kind, and one unknown."""
    start, end = [0.0, 0.4, 0.0], [1.2, 0.9, 0.2]
    problem = {"robot": "planar", "start": start, "goal": {"joints": end}}
    return {
        **window(),
        "path": [start, end],
        "trajectory": timed([start, end]),
        "problem": {**problem, "obstacles": copy.deepcopy(SHAPES), "margin": 0.0},
        "robot": planar(),
    }
