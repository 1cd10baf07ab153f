"""``rollout_settings_t`` of runtime/rollout.c, made from a planner's settings."""

from __future__ import annotations

import ctypes as ct
from typing import Any

import numpy as np

from rrnn_opt.planning.settings.random_rnn import RandomRnn
from rrnn_opt.planning.settings.rollout import PaperRnn, RolloutSettings, SingleRollout
from rrnn_opt.robot import Robot
from rrnn_opt.robot.reach import reach_ball

_DOUBLES = (
    "epsilon",
    "step",
    "safe",
    "share",
    "random_tolerance",
    "stall_ratio",
    "radius",
    "slack",
    "gain",
    "speed",
    "rate",
    "kappa_o",
    "inner",
)
_INTEGERS = (
    "law",
    "by_index",
    "by_posture",
    "feed",
    "stall_window",
    "max_steps",
    "sweeps",
    "contacts",
)
FEEDS = ("contact", "band", "failure")
SPARE = 2.0
"""A step longer than this many times the speed limits is taken for a collision."""


class RolloutStruct(ct.Structure):
    """``rollout_settings_t`` of runtime/rollout.c."""

    _fields_ = (
        *((name, ct.c_double) for name in _DOUBLES),
        ("center", ct.c_double * 3),
        ("ball", ct.c_double),
        *((name, ct.c_int32) for name in _INTEGERS),
    )


def rollout_struct(robot: Robot, settings: RolloutSettings) -> RolloutStruct:
    """``rollout_settings_t`` of a planner's settings."""
    speed = float(np.linalg.norm(robot.limits.velocity))
    common = {
        "step": settings.step,
        "share": settings.share,
        "stall_ratio": settings.stall_ratio,
        "radius": SPARE * speed * settings.step,
        "slack": RandomRnn().slack,
        "stall_window": max(1, round(settings.stall_time / settings.step)),
        "max_steps": max(1, round(settings.max_time / settings.step)),
    }
    own = (
        _paper(robot, settings) if isinstance(settings, PaperRnn) else _single(settings)
    )
    struct = RolloutStruct(**common, **own)
    centre, struct.ball = reach_ball(robot)
    struct.center[:] = list(centre)
    return struct


def _paper(robot: Robot, settings: PaperRnn) -> dict[str, Any]:
    return {
        "epsilon": settings.epsilon,
        "safe": settings.safe,
        "random_tolerance": settings.random_tolerance,
        "law": ("first", "second").index(settings.order),
        "by_index": settings.reading == "index",
        "by_posture": settings.region == "posture",
        "feed": FEEDS.index(settings.feed),
    }


def _single(settings: SingleRollout) -> dict[str, Any]:
    return {
        "safe": settings.outer,
        "inner": settings.inner,
        "gain": settings.gain,
        "speed": settings.speed,
        "rate": settings.rate,
        "kappa_o": settings.kappa_o,
        "sweeps": settings.sweeps,
        "contacts": settings.contacts,
        "law": 2 + ("velocity", "acceleration").index(settings.level),
        "feed": FEEDS.index("failure"),
    }
