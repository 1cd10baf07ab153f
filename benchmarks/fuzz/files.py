"""Files of robots and scenes: problems, URDF, spheres, meshes, clouds, tasks."""

from __future__ import annotations

import io
import json
import math
import random
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.fuzz import bases, mutation, xml
from benchmarks.fuzz.judging import ACCEPTED, Entry, require

LARGEST = 1e9


def sound(value: Any, what: str, *, infinite: bool = False) -> None:
    """Every number in plain data is finite and no text is odd."""
    if isinstance(value, dict):
        for key, entry in value.items():
            sound(entry, f"{what}.{key}", infinite=infinite)
    elif isinstance(value, list | tuple):
        for entry in value:
            sound(entry, what, infinite=infinite)
    elif isinstance(value, float) and not infinite:
        require(math.isfinite(value), f"{what} is {value}")


def _true_robot(robot: Any) -> None:
    data = json.loads(json.dumps(robot.to_dict(), allow_nan=False))
    require(robot.nv >= 1, "a robot without a joint")
    lower, upper = robot.limits.lower, robot.limits.upper
    require(np.all(lower <= upper), "a joint whose limits are crossed")
    for rate in (robot.limits.velocity, robot.limits.acceleration):
        require(np.all(np.isfinite(rate) & (rate > 0)), "a rate limit is no limit")
    rotations = robot.tree.placements[:, :3, :3]
    gram = np.swapaxes(rotations, 1, 2) @ rotations
    require(np.allclose(gram, np.eye(3), atol=1e-9), "a joint's axes are bent")
    require(len(set(robot.joint_names)) == robot.nv, "two joints of one name")
    for sphere in robot.spheres:
        require(0.0 < sphere.radius < LARGEST, f"a sphere of radius {sphere.radius}")
        require(np.all(np.abs(sphere.center) < LARGEST), "a sphere beyond all bounds")
    sound(data, "robot")


def _true_problem(problem: Any) -> None:
    from rrnn_opt.planning import Problem

    data = json.loads(json.dumps(problem.to_dict(), allow_nan=False))
    _true_robot(problem.robot)
    sound(data, "problem")
    limits = problem.robot.limits
    inside = (limits.lower <= problem.start) & (problem.start <= limits.upper)
    require(np.all(inside), "the start is outside the limits")
    require(problem.margin >= 0.0, "a negative margin")
    for obstacle in problem.scene:
        require(np.all(np.isfinite(obstacle.pack())), "an obstacle is not finite")
    again = Problem.from_dict(data).to_dict()
    require(json.dumps(again) == json.dumps(data), "read again it is another problem")


def problem_document(rng: random.Random, folder: Path) -> str:
    """A problem whose entries are changed, as plain data."""
    from rrnn_opt.planning import Problem

    bases.lay_out(folder)
    base = rng.choice((bases.PROBLEM, bases.PROBLEM, bases.URDF_PROBLEM))
    data = mutation.document(rng, base)
    problem = Problem.from_dict(data, base_dir=folder)
    if problem.robot_ref in ("planar3", "pa10", "panda", "raven2"):
        _true_problem(problem)
    else:
        _true_robot(problem.robot)
    return ACCEPTED


def problem_file(rng: random.Random, folder: Path) -> str:
    """A problem file, changed as a document, as text or as bytes."""
    from rrnn_opt.planning import Problem

    bases.lay_out(folder)
    path = folder / "problem.json"
    path.write_bytes(mutation.json_bytes(rng, bases.PROBLEM))
    _true_problem(Problem.load(path))
    return ACCEPTED


def scene(rng: random.Random, folder: Path) -> str:
    """A list of obstacles."""
    from rrnn_opt.scene.reading import scene_from_list

    bases.lay_out(folder)
    base = [*bases.OBSTACLES, *bases.URDF_PROBLEM["obstacles"]]
    found = scene_from_list(mutation.document(rng, base), base_dir=folder)
    data = json.loads(json.dumps(found.to_dict(), allow_nan=False))
    sound(data, "scene")
    for obstacle in found:
        require(np.all(np.isfinite(obstacle.pack())), "an obstacle is not finite")
    return ACCEPTED


def urdf(rng: random.Random, folder: Path) -> str:
    """A URDF: changed as a tree or as text, or one of the known tricks."""
    from rrnn_opt.robot import Robot

    bases.lay_out(folder)
    path = folder / "robot.urdf"
    path.write_bytes(xml.robot(rng, bases.URDF))
    tip = rng.choice((None, None, "hand", "nowhere", ""))
    _true_robot(Robot.from_urdf(path, tip=tip))
    return ACCEPTED


def fitted(rng: random.Random, folder: Path) -> str:
    """A URDF whose meshes are damaged, to the fitting of spheres."""
    from rrnn_opt.robot.fitting.fit import fit_spheres

    text = xml.with_mesh(rng, bases.URDF)
    (folder / "robot.urdf").write_bytes(text)
    (folder / "part.stl").write_bytes(_mesh(rng, ".stl"))
    (folder / "part.obj").write_bytes(_mesh(rng, ".obj"))
    found = fit_spheres(folder / "robot.urdf", most=4, inflation=0.05)
    data = json.loads(json.dumps(found.to_dict(), allow_nan=False))
    sound(data, "spheres")
    return ACCEPTED


def spheres(rng: random.Random, folder: Path) -> str:
    """A sphere file beside a good URDF."""
    from rrnn_opt.robot import Robot

    bases.lay_out(folder)
    path = folder / "spheres.json"
    path.write_bytes(mutation.json_bytes(rng, bases.SPHERES))
    _true_robot(Robot.from_urdf(folder / "arm.urdf", tip="hand", spheres=path))
    return ACCEPTED


def _mesh(rng: random.Random, suffix: str) -> bytes:
    if suffix == ".obj":
        data = bases.OBJ.encode()
    else:
        data = rng.choice((bases.binary_stl(), bases.ASCII_STL.encode()))
    if rng.random() < 0.4:
        text = mutation.characters(rng, data.decode("latin1"))
        return text.encode("latin1", "replace")
    return mutation.raw(rng, data)


def mesh(rng: random.Random, folder: Path) -> str:
    """A mesh file as an obstacle; the other reader must agree with ours."""
    from rrnn_opt.check.plans.solids.files import read_points
    from rrnn_opt.scene import Mesh

    suffix = rng.choice((".stl", ".stl", ".obj", ".ply", ".STL"))
    path = folder / f"part{suffix}"
    path.write_bytes(_mesh(rng, suffix.lower()))
    found = Mesh("part", str(path), scale=rng.choice((1.0, 1.0, 1e-3, 1e6)))
    require(np.all(np.isfinite(found.pack())), "a hull is not finite")
    require(len(found.normals) >= 4, "a hull of fewer than four facets")
    lengths = np.linalg.norm(found.normals, axis=1)
    require(np.allclose(lengths, 1.0, atol=1e-6), "a normal of another length")
    if suffix.lower() != ".ply":
        theirs = found.scale * read_points(found.to_dict(), "obstacle")
        excess = (found.normals @ theirs.T).max(axis=1) - found.offsets
        require(np.all(excess <= 1e-9 * found.scale), "a vertex is cut off")
    return ACCEPTED


def cloud(rng: random.Random, folder: Path) -> str:
    """A file of points as an obstacle; the other reader must agree with ours."""
    from rrnn_opt.check.plans.solids.files import read_points
    from rrnn_opt.scene import Points

    suffix = rng.choice((".npy", ".npy", ".csv"))
    path = folder / f"cloud{suffix}"
    path.write_bytes(_cloud(rng, suffix))
    found = Points("cloud", str(path), 0.01)
    require(np.all(np.isfinite(found.centers)), "a point is not finite")
    theirs = read_points(found.to_dict(), "obstacle")
    require(np.array_equal(found.centers, theirs), "the checker reads other points")
    return ACCEPTED


def _cloud(rng: random.Random, suffix: str) -> bytes:
    if suffix == ".csv":
        if rng.random() < 0.6:
            return mutation.characters(rng, bases.CSV).encode("utf-8", "replace")
        return mutation.raw(rng, bases.CSV.encode())
    shape = rng.choice(((4, 3), (4, 3), (0, 3), (3,), (2, 2), (2, 3, 1)))
    kind = rng.choice(("f8", "f8", "f4", ">f8", "i2", "c16", "U3", "O", "?", "M8[s]"))
    array = np.zeros(shape, dtype=kind)
    file = io.BytesIO()
    if rng.random() < 0.1:
        np.savez(file, array)
    else:
        np.save(file, array, allow_pickle=True)
    data = file.getvalue()
    if rng.random() < 0.3:
        size = rng.choice((b"99999999999999", b"-1", b"1e9", b"True", b"__import__"))
        return data.replace(b"(4,", b"(" + size + b",", 1)
    return mutation.raw(rng, data) if rng.random() < 0.7 else data


def task(rng: random.Random, folder: Path) -> str:
    """A TASK.toml."""
    from rrnn_opt.simulation import Task

    text = bases.TASK
    for _ in range(rng.choice((1, 1, 2))):
        if rng.random() < 0.5:
            text = mutation.characters(rng, text)
        else:
            lines = text.splitlines()
            at = rng.randrange(len(lines))
            key = lines[at].split("=")[0]
            value = "["
            if rng.random() < 0.8:
                value = mutation.json_text(mutation.junk(rng))
            lines[at] = f"{key} = {value.replace('null', '[]')}"
            text = "\n".join(lines)
    data = text.encode("utf-8", "surrogatepass")
    path = folder / "task.toml"
    path.write_bytes(mutation.raw(rng, data) if rng.random() < 0.1 else data)
    found = Task.load(path)
    require(found.control.dt > 0 and found.curve.duration > 0, "no time")
    require(np.all(np.isfinite(found.q0)), "q0 is not finite")
    require(1 <= found.steps <= 10_000_000, "too many steps")
    return ACCEPTED


ENTRIES = (
    Entry("problem document", problem_document, 5),
    Entry("problem file", problem_file, 3),
    Entry("scene", scene, 3),
    Entry("URDF", urdf, 5),
    Entry("URDF with meshes", fitted, 1),
    Entry("sphere file", spheres, 3),
    Entry("mesh file", mesh, 3),
    Entry("point cloud", cloud, 3),
    Entry("task file", task, 3),
)
