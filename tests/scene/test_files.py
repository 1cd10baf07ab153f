"""Hulls of meshes: what is read, against scipy, coal and the checker's own reading."""

import sys
from pathlib import Path

import coal
import numpy as np
import pytest

from rrnn_opt.check.plans.solids.obstacle import read_obstacle
from rrnn_opt.errors import DocumentError, ProblemError
from rrnn_opt.scene import Box, HalfSpace, Mesh, Points, Scene
from rrnn_opt.scene.broad import WIDTH, broad_phase
from rrnn_opt.scene.mesh_file import read_vertices
from rrnn_opt.scene.reading import scene_from_list
from rrnn_opt.scene.records import SOLIDS
from tests.check.plans.one_solid import OneSolid

TURN = [0.18257418583505536, 0.3651483716701107, 0.5477225575051661, 0.7302967433402214]


def triangles_of(count=60, seed=2):
    rng = np.random.default_rng(seed)
    return rng.normal(size=(count, 3, 3)) * [0.1, 0.2, 0.3]


def write_stl(path, triangles, *, binary=True):
    if not binary:
        corner = "vertex {:.9g} {:.9g} {:.9g}\n"
        body = "".join(
            "facet normal 0 0 0\nouter loop\n"
            + "".join(corner.format(*v) for v in t)
            + "endloop\nendfacet\n"
            for t in triangles
        )
        path.write_text(f"solid x\n{body}endsolid x\n")
        return path
    rows = np.zeros(
        len(triangles), [("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")]
    )
    rows["v"] = triangles
    head = b"solid misleading".ljust(80) + len(rows).to_bytes(4, "little")
    path.write_bytes(head + rows.tobytes())
    return path


def write_obj(path, triangles):
    lines = [
        "# a comment",
        *("v {:.9g} {:.9g} {:.9g}".format(*v) for v in triangles.reshape(-1, 3)),
    ]
    path.write_text("\n".join([*lines, "vn 0 0 1", "f 1 2 3"]))
    return path


def test_formats_agree(tmp_path):
    t = triangles_of().astype(np.float32)
    want = np.unique(t.reshape(-1, 3), axis=0)
    files = [
        write_stl(tmp_path / "a.stl", t),
        write_stl(tmp_path / "b.STL", t, binary=False),
        write_obj(tmp_path / "c.obj", t),
    ]
    for path in files:
        np.testing.assert_allclose(read_vertices(path), want, atol=1e-7)


@pytest.fixture
def mesh(tmp_path):
    path = write_stl(tmp_path / "rock.stl", triangles_of())
    return Mesh("rock", str(path), 1.5, [0.4, -0.2, 0.3], TURN)


def coal_distance(mesh, points):
    corners = coal.StdVec_Vec3s()
    corners.extend(list(mesh.vertices))
    hull = coal.Convex.convexHull(corners, True, "")
    pose = coal.Transform3s(mesh.rotation, mesh.position)
    request, result = coal.DistanceRequest(), coal.DistanceResult()
    found = []
    for p in points:
        result.clear()
        at = coal.Transform3s(np.eye(3), p)
        found.append(coal.distance(coal.Sphere(1e-9), at, hull, pose, request, result))
    return np.array(found) + 1e-9


def test_facets_bound_the_distance_from_below_and_meet_it_on_faces(mesh, rng_points):
    facets = mesh.pack()[1:]
    planes = rng_points @ facets[:, 6:9].T - facets[:, 12]
    lower, true = planes.max(axis=1), coal_distance(mesh, rng_points)
    outside = true > 1e-6
    assert outside.sum() > 50
    assert np.all(lower[outside] <= true[outside] + 1e-7)
    middles = mesh.corners()[mesh.triangles].mean(axis=1)
    n = np.array([f[6:9] for f in facets])
    onto = middles[:, None] @ n.transpose()[None]
    best = (onto[:, 0] - facets[:, 12]).argmax(axis=1)
    above = middles + 0.05 * n[best]
    np.testing.assert_allclose(
        (above @ n.T - facets[:, 12]).max(axis=1), 0.05, atol=1e-9
    )


@pytest.fixture
def rng_points():
    return np.random.default_rng(5).uniform(-1.5, 1.5, (300, 3))


def test_the_checker_finds_the_true_distance_on_its_own(mesh, rng_points):
    solid = OneSolid(mesh.to_dict())
    true, found = coal_distance(mesh, rng_points), solid.distance(rng_points)
    outside = true > 1e-6
    np.testing.assert_allclose(found[outside], true[outside], atol=1e-6)
    assert np.all(found[true < -1e-6] < 0.0)
    n = solid.normals(rng_points)
    np.testing.assert_allclose(np.linalg.norm(n, axis=1), 1.0, atol=1e-12)
    bound = solid.gap(rng_points, n)
    np.testing.assert_allclose(bound[outside], found[outside], atol=1e-9)
    tilted = n + 0.3
    tilted /= np.linalg.norm(tilted, axis=1)[:, None]
    assert np.all(solid.gap(rng_points, tilted) <= found + 1e-12)


def test_a_changed_file_is_noticed(mesh):
    document = mesh.to_dict()
    write_stl(Path(mesh.path), triangles_of(seed=3))
    with pytest.raises(ProblemError, match="not the file that it was"):
        scene_from_list([document])
    with pytest.raises(DocumentError, match="has changed"):
        read_obstacle(document, "rock")


def test_flat_and_missing_meshes_are_refused(tmp_path):
    flat = triangles_of() * [1, 1, 0]
    with pytest.raises(ProblemError, match="lie in a plane"):
        Mesh("m", str(write_stl(tmp_path / "flat.stl", flat)))
    with pytest.raises(ProblemError, match="cannot be read"):
        Mesh("m", str(tmp_path / "none.stl"))
    (tmp_path / "bad.obj").write_text("v 1 2 x")
    with pytest.raises(ProblemError, match="no readable mesh"):
        Mesh("m", str(tmp_path / "bad.obj"))


def test_other_formats_are_read_by_trimesh(tmp_path):
    trimesh = pytest.importorskip("trimesh")
    box = trimesh.creation.box((1.0, 2.0, 3.0))
    box.export(tmp_path / "box.ply")
    np.testing.assert_array_equal(
        read_vertices(tmp_path / "box.ply", "path"), np.unique(box.vertices, axis=0)
    )
    (tmp_path / "torn.ply").write_bytes((tmp_path / "box.ply").read_bytes()[:200])
    (tmp_path / "box.nothing").write_text("v 1 2 3")
    for name in ("torn.ply", "box.nothing"):
        with pytest.raises(ProblemError, match="no readable mesh: trimesh says"):
            read_vertices(tmp_path / name, "path")


def test_without_trimesh_its_formats_are_refused(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "trimesh", None)
    (tmp_path / "box.ply").write_text("ply")
    with pytest.raises(ProblemError, match=r"ply needs trimesh.*obj do not"):
        read_vertices(tmp_path / "box.ply", "path")


@pytest.mark.parametrize("text", ["v 1 2 nan", "# nothing", "v 1 inf 2"])
def test_a_mesh_needs_finite_vertices(tmp_path, text):
    (tmp_path / "bad.obj").write_text(text)
    with pytest.raises(ProblemError, match="holds no finite vertices"):
        read_vertices(tmp_path / "bad.obj", "path")


def test_every_solid_hangs_on_the_tree_once_inside_its_boxes(tmp_path, mesh):
    points = np.random.default_rng(1).uniform(-1, 1, (1001, 3))
    np.save(tmp_path / "p.npy", points)
    scene = Scene(
        (
            Box("b", [1, 2, 3], [4, 5, 6], TURN),
            Points("p", str(tmp_path / "p.npy"), 0.01),
            HalfSpace("h", [0, 0, 1], 0.0),
            mesh,
        )
    )
    tree = broad_phase(scene)
    solids = tree.solids
    assert tree.flat == 1
    assert SOLIDS[solids.kind[0]] == "halfspace"
    seen, stack = [], [0]
    while stack:
        node = stack.pop()
        children = np.arange(tree.first[node], tree.first[node] + tree.size[node])
        assert 0 < len(children) <= WIDTH
        boxes = solids.bounds[children] if node >= tree.leaf else tree.bounds[children]
        assert np.all(tree.bounds[node, :3] <= boxes[:, :3].min(axis=0))
        assert np.all(tree.bounds[node, 3:] >= boxes[:, 3:].max(axis=0))
        if node >= tree.leaf:
            seen += children.tolist()
        else:
            stack += children.tolist()
    assert sorted(seen) == list(range(1, 1004))
    hull = int(np.flatnonzero(solids.kind == SOLIDS.index("hull"))[0])
    assert solids.owner[hull] == 3
    assert solids.rows[solids.first[hull], 12] == len(mesh.normals)
