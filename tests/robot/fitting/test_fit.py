"""Fitted spheres hold what they stand for: proof, coal, and a mutation of both."""

import json

import casadi as ca
import coal
import numpy as np
import pytest
from scipy.spatial import ConvexHull

from rrnn_opt.cli.main import main
from rrnn_opt.errors import RobotError
from rrnn_opt.robot import Kinematics, Robot
from rrnn_opt.robot.fitting import fit
from rrnn_opt.robot.fitting.apart import levers, never_touch
from rrnn_opt.robot.fitting.ball import smallest_ball
from rrnn_opt.robot.fitting.cover_proof import uncovered
from rrnn_opt.robot.fitting.fit import fit_spheres
from rrnn_opt.robot.fitting.geometry import collision_geometry, load_mesh
from rrnn_opt.robot.fitting.solid_cover import PADDING, Surface, cover_solid
from rrnn_opt.robot.loading.urdf import read_urdf


def outward(points):
    hull = ConvexHull(points)
    triangles = hull.simplices.astype(np.int64)
    e = points[triangles]
    n = np.cross(e[:, 1] - e[:, 0], e[:, 2] - e[:, 0])
    inward = np.einsum("ij,ij->i", n, hull.equations[:, :3]) < 0
    triangles[inward] = triangles[inward][:, ::-1]
    return triangles


@pytest.fixture
def tube():
    turns = np.linspace(0.0, 2 * np.pi, 24, endpoint=False)
    points = np.array(
        [[0.05 * np.cos(a), 0.05 * np.sin(a), z] for a in turns for z in (0.0, 0.4)]
    )
    return points, outward(points)


def surface_points(points, triangles, count, rng):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    owner = rng.integers(len(triangles), size=count)
    u, v = rng.random((2, count))
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    return a[owner] + u[:, None] * (b - a)[owner] + v[:, None] * (c - a)[owner]


def test_the_union_holds_the_surface(tube):
    points, triangles = tube
    cover = cover_solid(points, triangles, inflation=0.03, most=16)
    assert len(uncovered(points, triangles, cover.centers, cover.radii)) == 0
    on = surface_points(points, triangles, 20_000, np.random.default_rng(0))
    away = np.linalg.norm(on[:, None] - cover.centers, axis=2) - cover.radii
    assert away.min(axis=1).max() <= 0.0
    assert len(cover.radii) <= 16


def test_a_gap_is_not_overlooked(tube):
    """With any one sphere left out, or all of them smaller, something shows."""
    points, triangles = tube
    cover = cover_solid(points, triangles, inflation=0.03, most=8)
    for k in range(len(cover.radii)):
        kept = np.arange(len(cover.radii)) != k
        left = uncovered(
            points, triangles, cover.centers[kept], cover.radii[kept], depth=6
        )
        assert len(left)
    small = 0.97 * (cover.radii - PADDING)
    assert len(uncovered(points, triangles, cover.centers, small, depth=6))


def test_bulge_is_measured_outside_only():
    corners = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, -1).T * 0.1
    box = Surface(corners, outward(corners))
    found = box.outside(np.array([[0.0, 0, 0], [0.15, 0, 0], [0, 0, -0.2]]))
    np.testing.assert_allclose(found, [0.0, 0.05, 0.1], atol=5e-3)
    flipped = Surface(corners, outward(corners)[:, ::-1])
    np.testing.assert_allclose(flipped.outside(np.zeros((1, 3))), 0.0)


def test_smallest_balls_hold_their_points_and_are_small():
    rng = np.random.default_rng(3)
    for _ in range(20):
        points = rng.normal(size=(40, 3))
        center, radius = smallest_ball(points)
        away = np.linalg.norm(points - center, axis=1)
        assert away.max() <= radius + 1e-12
        far = np.linalg.norm(points[:, None] - points, axis=2).max()
        assert radius >= far / 2 - 1e-12
        assert radius <= 1.05 * far / np.sqrt(3)


@pytest.fixture(scope="session")
def xarm(robots_folder):
    return robots_folder / "xarm_description" / "urdf" / "xarm7.urdf"


URDF = """<robot name="two"><link name="base"><collision><geometry>
<mesh filename="package://meshes/tube.obj" scale="2 1 1"/></geometry></collision></link>
<link name="arm"><visual><origin xyz="0 0 0.2" rpy="0.3 0 0"/><geometry>
<box size="0.1 0.1 0.4"/></geometry></visual></link><joint name="turn"
type="continuous"><parent link="base"/><child link="arm"/><origin xyz="0 0 0.5"/>
<axis xyz="0 0 1"/><limit velocity="1" effort="1"/></joint></robot>"""


@pytest.fixture
def two(tmp_path, tube):
    points, triangles = tube
    (tmp_path / "meshes").mkdir()
    lines = ["v {} {} {}".format(*p) for p in points]
    lines += ["f {} {} {}".format(*(t + 1)) for t in triangles]
    (tmp_path / "meshes" / "tube.obj").write_text("\n".join(lines))
    path = tmp_path / "two.urdf"
    path.write_text(URDF)
    return path


def test_the_command_writes_a_file_that_the_robot_reads(two, tmp_path, capfd):
    out = tmp_path / "out" / "two.json"
    assert main(["spheres", str(two), "--out", str(out), "--json"]) == 0
    facts = json.loads(capfd.readouterr().out)
    assert facts["covered"] is True
    assert facts["visual_geometry"] == ["arm"]
    assert ["base", "arm", "adjacent"] in facts["disabled_self_collision_pairs"]
    robot = Robot.from_urdf(two, spheres=out)
    assert len(robot.spheres) == facts["spheres"]
    vertices, triangles = load_mesh(
        tmp_path / "meshes" / "tube.obj", np.array([2, 1, 1])
    )
    balls = [s for s in robot.spheres if s.link == "base"]
    centers = np.array([s.center for s in balls])
    radii = np.array([s.radius for s in balls])
    assert len(uncovered(vertices, triangles, centers, radii)) == 0
    assert np.abs(vertices).max() > 0.09
    coal_agrees(vertices, triangles, centers, radii)


def coal_agrees(vertices, triangles, centers, radii):
    """Coal's own distance of random surface points to the nearest ball is negative."""
    on = surface_points(vertices, triangles, 200, np.random.default_rng(1))
    point, none = coal.Sphere(1e-9), np.eye(3)
    request, result = coal.DistanceRequest(), coal.DistanceResult()
    for p in on:
        best = np.inf
        for c, r in zip(centers, radii, strict=True):
            result.clear()
            at, ball = coal.Transform3s(none, p), coal.Transform3s(none, c)
            shape = coal.Sphere(r)
            d = coal.distance(point, at, shape, ball, request, result)
            best = min(best, d)
        assert best <= 1e-8


LINKS = """<robot name="passing"><link name="base"><collision>
<origin xyz="0 0 0.05"/><geometry><box size="0.1 0.1 0.1"/></geometry></collision>
</link><link name="mid"><collision><origin xyz="0.45 0 0.15"/><geometry>
<box size="0.3 0.06 0.06"/></geometry></collision></link>
<link name="far"><collision><origin xyz="-0.12 0 0"/><geometry>
<box size="0.2 0.06 0.06"/></geometry></collision></link>
<joint name="one" type="revolute"><parent link="base"/><child link="mid"/>
<origin xyz="0 0 0"/><axis xyz="0 0 1"/>
<limit lower="-2" upper="2" velocity="1" effort="1"/></joint>
<link name="hub"/><joint name="two" type="revolute">
<parent link="mid"/><child link="hub"/>
<origin xyz="0.6 0 {height}"/><axis xyz="0 0 1"/>
<limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
<joint name="three" type="revolute"><parent link="hub"/><child link="far"/>
<axis xyz="{axis}"/><limit lower="-0.02" upper="0.02" velocity="1" effort="1"/></joint>
</robot>"""


def passing(tmp_path, height, axis="0 0 1"):
    """A link that folds back over another one; by default it stays above it."""
    path = tmp_path / f"passing_{height}_{axis[0]}.urdf"
    path.write_text(LINKS.format(height=height, axis=axis))
    return path


@pytest.mark.slow
def test_spheres_are_added_where_links_pass_each_other(tmp_path, monkeypatch):
    """The gap of 25 mm is less than the bulges: more spheres leave room for it."""
    monkeypatch.setattr(fit, "NEIGHBOURS", 0)
    monkeypatch.setattr(fit, "POSTURES", 60)
    path = passing(tmp_path, 0.235)
    coarse = fit_spheres(path, tip="far", inflation=0.02, most=4, extra=0)
    fine = fit_spheres(path, tip="far", inflation=0.02, most=4, extra=24)
    assert coarse.covered
    assert fine.covered
    assert coarse.contact == coarse.before
    assert fine.before == coarse.before
    assert fine.contact.geometry == 0.0
    assert fine.contact.false < 0.8 * coarse.contact.false
    added = [sum(len(c.balls) for c in f.links) for f in (coarse, fine)]
    assert 0 < added[1] - added[0] <= 28
    again = fit_spheres(path, tip="far", inflation=0.02, most=4, extra=24)
    assert again.to_dict() == fine.to_dict()


@pytest.mark.parametrize(("height", "verdict"), [(0.25, "apart"), (0.2, "touching")])
def test_links_are_proved_apart_or_shown_to_touch(tmp_path, height, verdict):
    """Boxes of 6 cm whose middles stay 10 cm, or 5 cm, apart along z."""
    path = passing(tmp_path, height)
    geometry, _ = collision_geometry(read_urdf(path))
    robot = Robot.from_urdf(path, tip="far")
    found = never_touch(robot, "mid", "far", geometry)
    assert found.verdict == verdict
    if verdict == "apart":
        assert found.gap == pytest.approx(height - 0.21, abs=1e-6)
    assert never_touch(robot, "mid", "far", geometry, most=1).boxes == 1


def test_levers_bound_every_change_of_distance(tmp_path):
    path = passing(tmp_path, 0.22, axis="0 1 0")
    geometry, _ = collision_geometry(read_urdf(path))
    robot = Robot.from_urdf(path, tip="far")
    lever = levers(robot, "base", "far", geometry)
    kin = Kinematics(robot)
    poses = ca.Function("p", [kin.q], [kin.pose("base"), kin.pose("far")])
    points = [geometry[link][0].extremes() for link in ("base", "far")]
    rng = np.random.default_rng(0)
    worst = 0.0
    for _ in range(300):
        start = rng.uniform(robot.limits.lower, robot.limits.upper)
        step = 1e-3 * np.eye(robot.nv)[rng.integers(robot.nv)]
        away = []
        for q in (start, start + step):
            pairs = zip(points, (np.array(pose) for pose in poses(q)), strict=True)
            one, other = (p @ pose[:3, :3].T + pose[:3, 3] for p, pose in pairs)
            away.append(np.linalg.norm(one[:, None] - other, axis=2))
        share = np.abs(away[1] - away[0]).max() / (lever @ step)
        worst = max(worst, share)
    assert 0.9 < worst <= 1.0 + 1e-9  # it holds and wastes little


def test_a_mesh_that_is_not_there_is_named(two, tmp_path):
    (tmp_path / "meshes" / "tube.obj").unlink()
    with pytest.raises(RobotError, match=r"no mesh 'package://meshes/tube\.obj'"):
        fit_spheres(two)


@pytest.mark.slow
def test_an_arm_of_meshes_is_covered(xarm):
    fitted = fit_spheres(xarm, tip="link7")
    assert fitted.covered
    assert sum(cover.triangles for cover in fitted.links) > 1000
    assert max(cover.inflation for cover in fitted.links) < 0.1
