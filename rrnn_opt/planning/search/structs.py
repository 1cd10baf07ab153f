"""The runtime's C structures (runtime/types.h) as ctypes, and what it reports."""

from __future__ import annotations

import ctypes as ct
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.planning.settings.random_rnn import RandomRnn

Array = NDArray[np.float64]
NEAR_MAX = 4096
"""Pairs that a step lists, at most; as in runtime/types.h."""


def doubles_at(address: int | None, shape: tuple[int, ...]) -> Array:
    """A copy of what the runtime keeps at an address.

    ``numpy.ctypeslib.as_array`` would leave a new ctypes type behind for every shape.
    """
    found = np.empty(shape)
    if found.size:
        ct.memmove(found.ctypes.data, ct.c_void_p(address), found.nbytes)
    return found


class Settings(ct.Structure):
    """``settings_t`` of runtime/types.h."""

    _fields_ = (
        *(
            (name, ct.c_double)
            for name in (
                "max_step",
                "min_step",
                "steering",
                "slack",
                "stall_ratio",
                "node_gap",
                "ik_step",
                "ik_share",
                "sweep_least",
                "coin",
            )
        ),
        *(
            (name, ct.c_int32)
            for name in (
                "max_slide_steps",
                "stall_window",
                "sweeps",
                "rows_per_pass",
                "passes",
                "max_roots",
                "ik_steps",
                "ik_tries",
                "edge",
                "project",
                "connect",
                "drive",
                "close_after",
            )
        ),
    )


class TipTarget(ct.Structure):
    """``tip_goal_t``."""

    _fields_ = (
        ("position", ct.c_double * 3),
        ("rotation", ct.c_double * 9),
        ("half", ct.c_double * 3),
        ("free", ct.c_double * 3),
        ("tolerance", ct.c_double),
        ("chord", ct.c_double),
        ("has_rotation", ct.c_int32),
        ("reserved", ct.c_int32),
    )


class Request(ct.Structure):
    """``request_t``."""

    _fields_ = (
        *(
            (name, ct.c_void_p)
            for name in (
                "lower",
                "upper",
                "sample_lower",
                "sample_upper",
                "start",
                "kind",
                "shape",
                "joint_goals",
                "tip_goals",
                "first",
                "node_first",
                "node_size",
                "node_bounds",
            )
        ),
        ("margin", ct.c_double),
        ("seed", ct.c_uint64 * 2),
        ("obstacle_count", ct.c_int32),
        ("joint_goal_count", ct.c_int32),
        ("tip_goal_count", ct.c_int32),
        ("flat", ct.c_int32),
        ("nodes", ct.c_int32),
        ("leaf", ct.c_int32),
    )


class Closest(ct.Structure):
    """``closest_t``."""

    _fields_ = (
        ("gap", ct.c_double),
        ("sphere", ct.c_int32),
        ("other", ct.c_int32),
        ("is_self", ct.c_int32),
        ("reserved", ct.c_int32),
    )


class Near(ct.Structure):
    """``near_t``."""

    _fields_ = (
        ("sphere", ct.c_int32),
        ("other", ct.c_int32),
        ("group", ct.c_int32),
        ("gap", ct.c_double),
        ("normal", ct.c_double * 3),
    )


def settings_struct(settings: RandomRnn) -> Settings:
    """``settings_t`` of a planner's settings."""
    return Settings(
        max_step=settings.max_step,
        min_step=settings.min_step,
        steering=settings.steering_margin,
        slack=settings.slack,
        stall_ratio=settings.stall_ratio,
        node_gap=settings.node_gap,
        ik_step=settings.ik_step,
        ik_share=settings.ik_share,
        sweep_least=settings.sweep_least,
        coin=-1.0 if settings.coin is None else settings.coin,
        max_slide_steps=settings.max_slide_steps,
        stall_window=settings.stall_window,
        sweeps=settings.sweeps,
        rows_per_pass=settings.rows_per_pass,
        passes=settings.passes,
        max_roots=settings.max_roots,
        ik_steps=settings.ik_steps,
        ik_tries=settings.ik_tries,
        edge=settings.edge,
        project=settings.project,
        connect=settings.connect,
        drive=settings.drive,
        close_after=settings.close_after,
    )


@dataclass(frozen=True)
class Contact:
    """The closest pair at a posture.

    Attributes:
        gap: clearance less the promised margin, m.
        sphere: index of the robot's sphere.
        other: index of the obstacle, or of the second sphere.
        is_self: the pair is a self pair.
    """

    gap: float
    sphere: int
    other: int
    is_self: bool


@dataclass(frozen=True, eq=False)
class NearPair:
    """A pair that a step has to respect.

    Attributes:
        sphere: sphere that moves away along the normal.
        other: obstacle, or second sphere of a self pair.
        group: -1 for an obstacle.
        gap: clearance less the promised margin, m.
        normal: unit, from the other to the sphere, (3,).
        bound: motion bound B at the wish, m.
    """

    sphere: int
    other: int
    group: int
    gap: float
    normal: Array
    bound: float


@dataclass(frozen=True)
class SearchCounts:
    """What the search did: rollouts, nodes, steps and goal postures."""

    random: int
    heuristic: int
    nodes: int
    rollout_steps: int
    goal_postures: int
    ik_failures: int
