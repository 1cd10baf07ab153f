"""Where a delivered trajectory begins and ends."""

from __future__ import annotations

from typing import Any

import numpy as np
import pinocchio as pin

from benchmarks.follow.body import Follower


def ends_error(document: dict[str, Any]) -> tuple[float, float]:
    """Distance of the first posture from the start, and of the last from a goal.

    The second is a share of the goal's tolerance (of 1e-6 rad for joint goals);
    the nearest goal counts.
    """
    problem, robot = document["problem"], document["robot"]
    first, last = (np.array(document["trajectory"]["q"][k], float) for k in (0, -1))
    goals = problem["goal"] if isinstance(problem["goal"], list) else [problem["goal"]]
    begin = float(np.max(np.abs(first - np.array(problem["start"]))))
    follower = Follower(document)
    follower.at(last[None], 0.0 * last[None])
    tip = robot["tip"]
    place = np.array(tip["placement"], float)
    pose = follower.data.oMi[int(tip["joint"]) + 1] * pin.SE3(
        place[:3, :3], place[:3, 3]
    )
    return begin, min(_missed(goal, last, pose, robot) for goal in goals)


def _missed(
    goal: dict[str, Any], q: np.ndarray, pose: pin.SE3, robot: dict[str, Any]
) -> float:
    if "joints" in goal:
        off = q - np.array(goal["joints"], float)
        turning = [v is None for v in robot["limits"]["lower"]]
        off[turning] -= 2 * np.pi * np.round(off[turning] / (2 * np.pi))
        return float(np.max(np.abs(off))) / 1e-6
    way = float(np.linalg.norm(pose.translation - np.array(goal["position"], float)))
    missed = way / float(goal["tolerance"])
    if goal.get("quat_xyzw"):
        x, y, z, w = goal["quat_xyzw"]
        wanted = pin.Quaternion(w, x, y, z).toRotationMatrix()
        turn = float(np.linalg.norm(pin.log3(wanted.T @ pose.rotation)))
        missed = max(missed, turn / float(goal["angle_tolerance"]))
    return missed
