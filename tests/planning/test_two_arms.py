"""Two arms of one robot at once: 14 joints, both in one trajectory."""

import json
from importlib import metadata
from pathlib import Path

import numpy as np
import pytest

from rrnn_opt.planning import Problem, plan
from rrnn_opt.robot import Robot
from rrnn_opt.robot.fitting.fit import fit_spheres
from rrnn_opt.robot.fitting.geometry import Gap, collision_geometry
from rrnn_opt.robot.fitting.sampled import Sampled
from rrnn_opt.robot.loading.urdf import read_urdf
from rrnn_opt.validation.studies.clutter import scenes

TIPS = ("left_gripper", "right_gripper")


def baxter() -> Path:
    files = metadata.files("example-robot-data") or []
    file = next(file for file in files if file.name == "panda.urdf")
    robots = Path(str(file.locate())).resolve().parents[2]
    return robots / "baxter_description/urdf/baxter.urdf"


@pytest.fixture(scope="module")
def fitted():
    return fit_spheres(baxter(), tips=TIPS, inflation=0.03, most=8)


@pytest.fixture(scope="module")
def robot(fitted, tmp_path_factory):
    file = tmp_path_factory.mktemp("baxter") / "spheres.json"
    file.write_text(json.dumps(fitted.to_dict()), "utf-8")
    return Robot.from_urdf(baxter(), tips=TIPS, spheres=file)


@pytest.mark.slow
def test_spheres_of_both_arms_leave_most_free_postures_free(fitted, robot):
    """Coal on the meshes says which postures are free; it forbids many of them."""
    meshes, _ = collision_geometry(read_urdf(baxter()))
    sampled = Sampled(robot, meshes, 100, seed=7)
    every = np.arange(sampled.count)
    balls = {}
    for cover in fitted.links:
        centers, radii = (np.array(each) for each in zip(*cover.balls, strict=True))
        balls[cover.link] = sampled.points(cover.link, centers, every), radii
    touch, overlap = np.zeros((2, sampled.count), dtype=bool)
    for a, b in robot.self_pairs:
        (at, r), (to, s) = balls[a], balls[b]
        away = np.linalg.norm(at[:, :, None] - to[:, None], axis=-1)
        overlap |= np.any(away < r[:, None] + s, axis=(1, 2))
        gap = Gap(meshes[a], meshes[b])
        touch |= [gap.touching(sampled.poses[a][k], sampled.poses[b][k]) for k in every]
    assert not np.any(touch & ~overlap)
    free = ~touch
    assert np.count_nonzero(free) > 0.2 * sampled.count
    assert np.count_nonzero(free & ~overlap) > 0.5 * np.count_nonzero(free)


@pytest.mark.slow
def test_both_arms_of_baxter_move_and_keep_apart(robot):
    assert robot.nv == 14
    arms = {pair for pair in robot.self_pairs if "left_wrist" in pair}
    assert any("right_wrist" in pair for pair in arms)
    for seed, problem in enumerate(scenes(robot, 3, seed=0)):
        assert isinstance(problem, Problem)
        result = plan(problem, seed=seed)
        assert result.status == "solved", result.message
        moved = np.ptp(np.array(result.trajectory["q"]), axis=0)
        assert np.all(moved > 1e-3)  # every joint of both arms
