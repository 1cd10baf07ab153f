"""What the robot holds: its spheres contain it, and what cannot be held is refused."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from rrnn_opt.errors import ProblemError
from rrnn_opt.planning.problem.attached import (
    MOST,
    Attached,
    attached_from_list,
    with_attached,
)
from rrnn_opt.robot import Robot
from rrnn_opt.scene import Box, HalfSpace

QUAT = [0.1, -0.5, 0.3, 0.8]
POSE = {
    "position": [0.02, -0.03, 0.1],
    "quat_xyzw": (np.array(QUAT) / np.linalg.norm(QUAT)).tolist(),
}
TETRAHEDRON = np.array([[0, 0, 0], [0.2, 0, 0], [0, 0.1, 0], [0, 0, 0.15]])


@pytest.fixture
def panda():
    return Robot.builtin("panda")


def mesh_file(folder):
    faces = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]
    lines = [f"v {x} {y} {z}" for x, y, z in TETRAHEDRON]
    lines += ["f " + " ".join(str(k + 1) for k in face) for face in faces]
    (folder / "part.obj").write_text("\n".join(lines) + "\n")
    return "part.obj"


def own_points(kind, rng, count=2000):
    """Points of the solid in its own axes, m: drawn by definition, not by cover."""
    if kind == "box":
        return rng.uniform(-0.5, 0.5, (count, 3)) * [0.1, 0.2, 0.05]
    if kind == "mesh":
        return rng.dirichlet(np.ones(4), count) @ TETRAHEDRON
    far, turn = 0.04 * np.sqrt(rng.uniform(0, 1, count)), rng.uniform(0, 7, count)
    disc = np.stack([far * np.cos(turn), far * np.sin(turn)], axis=1)
    along = rng.uniform(-0.15, 0.15, (count, 1))
    if kind == "cylinder":
        return np.hstack([disc, along])
    ball = rng.normal(size=(count, 3))
    ball *= (
        0.04
        * rng.uniform(0, 1, (count, 1))
        / np.linalg.norm(ball, axis=1, keepdims=True)
    )
    if kind == "capsule":
        ball[:, 2:] += along
    return ball


SHAPES = {
    "box": {"type": "box", "size": [0.1, 0.2, 0.05]},
    "cylinder": {"type": "cylinder", "radius": 0.04, "length": 0.3},
    "capsule": {"type": "capsule", "radius": 0.04, "length": 0.3},
    "sphere": {"type": "sphere", "radius": 0.04},
    "mesh": {"type": "mesh"},
}


@pytest.mark.parametrize("kind", SHAPES)
def test_the_spheres_contain_all_that_is_held(panda, tmp_path, rng, kind):
    frame = panda.frame("panda_hand")
    given = {"frame": frame.name, "name": "held", **SHAPES[kind], **POSE}
    if kind == "mesh":
        given["path"] = mesh_file(tmp_path)
    if kind == "sphere":
        del given["quat_xyzw"]
    held = attached_from_list([given], base_dir=tmp_path)
    spheres = [s for s in with_attached(panda, held).spheres if s.link == "held"]
    turn = Rotation.from_quat(given.get("quat_xyzw", [0, 0, 0, 1]))
    points = turn.apply(own_points(kind, rng)) + POSE["position"]
    points = points @ frame.placement[:3, :3].T + frame.placement[:3, 3]
    centers = np.array([s.center for s in spheres])
    apart = np.linalg.norm(points[:, None] - centers, axis=2)
    outside = (apart - [s.radius for s in spheres]).min(axis=1).max()
    assert outside <= 1e-12
    assert {s.joint for s in spheres} == {frame.joint}


def test_a_small_cloud_is_held_point_by_point(panda, tmp_path):
    points = np.random.default_rng(1).uniform(-0.1, 0.1, (MOST + 1, 3))
    np.save(tmp_path / "few.npy", points[:MOST])
    np.save(tmp_path / "many.npy", points)
    frame = panda.frame("panda_hand")
    cloud = {"frame": frame.name, "type": "points", "radius": 0.01, "path": "few.npy"}
    held = attached_from_list([cloud], base_dir=tmp_path)
    spheres = [s for s in with_attached(panda, held).spheres if s.link == "attached0"]
    moved = points[:MOST] @ frame.placement[:3, :3].T + frame.placement[:3, 3]
    np.testing.assert_allclose([s.center for s in spheres], moved, atol=1e-15)
    assert {s.radius for s in spheres} == {0.01}
    with pytest.raises(ProblemError, match="attach a mesh") as caught:
        attached_from_list([{**cloud, "path": "many.npy"}], base_dir=tmp_path)
    assert caught.value.field == "attached[0].path"


@pytest.mark.parametrize(
    ("data", "field", "said"),
    [
        ({}, "attached", "expected a list"),
        ([3], "attached[0]", "expected an object"),
        ([{"type": "sphere"}], "attached[0].frame", "is missing"),
        ([{"frame": 3}], "attached[0].frame", "expected a text"),
        ([{"frame": "flange"}], "attached[0].type", "is missing"),
        (
            [
                {
                    "frame": "flange",
                    "type": "halfspace",
                    "normal": [0, 0, 1],
                    "offset": 0,
                }
            ],
            "attached[0].type",
            "has no end",
        ),
    ],
)
def test_what_cannot_be_held_is_named(data, field, said):
    with pytest.raises(ProblemError, match=said) as caught:
        attached_from_list(data)
    assert caught.value.field == field


def test_a_half_space_has_no_end():
    with pytest.raises(ProblemError, match="attach a box"):
        Attached("flange", HalfSpace("floor", [0.0, 0.0, 1.0], 0.0))


def test_what_was_held_before_is_taken_off(panda):
    name = panda.frames[-1].name
    box = Box("first", [0.1, 0.1, 0.1])
    once = with_attached(panda, (Attached(name, box),))
    assert once.cover["attached"] == ["first"]
    other = Attached(name, Box("second", [0.1, 0.1, 0.1]))
    links = {s.link for s in with_attached(once, (other,)).spheres}
    assert "second" in links
    assert "first" not in links
    bare = with_attached(once, ())
    assert (bare.spheres, bare.self_pairs) == (panda.spheres, panda.self_pairs)
    assert "attached" not in bare.cover
    with pytest.raises(ProblemError, match="already a link") as caught:
        with_attached(panda, (other, other))
    assert caught.value.field == "attached[1].name"


def test_two_that_move_on_different_joints_are_kept_apart(panda):
    pair = tuple(
        Attached(frame, Box(name, [0.05, 0.05, 0.05]))
        for frame, name in (("panda_link6", "a"), ("panda_link7", "b"))
    )
    pairs = with_attached(panda, pair).self_pairs
    assert ("a", "b") in pairs
    joints = {s.link: s.joint for s in panda.spheres}
    wanted = {
        (link, "b")
        for link, joint in joints.items()
        if joint != panda.frame("panda_link7").joint
    }
    assert wanted == {p for p in pairs if p[1] == "b" and p[0] != "a"}
