"""Two arms of one robot at once: 14 joints, both in one trajectory."""

import json
from importlib import metadata
from pathlib import Path

import numpy as np
import pytest

from rrnn_opt.planning import Problem, plan
from rrnn_opt.robot import Robot
from rrnn_opt.robot.spheres import fit_spheres
from rrnn_opt.validation.studies.clutter import scenes

TIPS = ("left_gripper", "right_gripper")


def baxter() -> Path:
    files = metadata.files("example-robot-data") or []
    file = next(file for file in files if file.name == "panda.urdf")
    robots = Path(str(file.locate())).resolve().parents[2]
    return robots / "baxter_description/urdf/baxter.urdf"


@pytest.mark.slow
def test_both_arms_of_baxter_move_and_keep_apart(tmp_path):
    fitted = fit_spheres(baxter(), tips=TIPS, inflation=0.03, most=8)
    file = tmp_path / "spheres.json"
    file.write_text(json.dumps(fitted.to_dict()), "utf-8")
    robot = Robot.from_urdf(baxter(), tips=TIPS, spheres=file)
    assert robot.nv == 14
    arms = {pair for pair in robot.self_pairs if "left_wrist" in pair}
    assert any("right_wrist" in pair for pair in arms)
    for seed, problem in enumerate(scenes(robot, 3, seed=0)):
        assert isinstance(problem, Problem)
        result = plan(problem, seed=seed, time_limit=20.0)
        assert result.status == "solved", result.message
        moved = np.ptp(np.array(result.trajectory["q"]), axis=0)
        assert np.all(moved > 1e-3)  # every joint of both arms
