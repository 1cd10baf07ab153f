"""Problems of the two scenarios, of MotionBenchMaker and of drawn clutter."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.search.clutter import scenes
from rrnn_opt.validation.tables.starts import start_problem

DATA = Path(__file__).with_name("mbm_panda.json")


def _quaternion(matrix: Sequence[Sequence[float]]) -> list[float]:
    from scipy.spatial.transform import Rotation

    return [float(x) for x in Rotation.from_matrix(np.array(matrix)[:3, :3]).as_quat()]


def document(problem: dict[str, Any], goal: str) -> dict[str, Any]:
    """A problem of the data file with its joint, position or pose goal."""
    goals: dict[str, dict[str, Any]] = {
        "joints": {"joints": problem["goal"]},
        "position": {"position": problem["goal_position"], "tolerance": 1e-3},
    }
    pose = {"quat_xyzw": _quaternion(problem["goal_pose"]), "angle_tolerance": 5e-3}
    goals["pose"] = goals["position"] | pose
    return {
        "robot": "panda",
        "start": problem["start"],
        "goal": goals[goal],
        "obstacles": problem["obstacles"],
    }


def cases(
    starts: int, seeds: int
) -> Iterator[tuple[str, str, list[tuple[dict[str, Any], int]]]]:
    """Family, goal, and its problem documents with their seeds."""
    for name in ("plane", "window"):
        yield name, "position", [(start_problem(name, i), i) for i in range(starts)]
    families = json.loads(DATA.read_text(encoding="utf-8"))["problems"]
    for goal in ("joints", "position", "pose"):
        for family, problems in families.items():
            documents = [document(p, goal) for p in problems]
            yield family, goal, [(d, s) for d in documents for s in range(seeds)]
    for kind in ("cage", "shelf"):
        yield kind, "position", [(d, 0) for d in scenes(kind, 20 * seeds)]
