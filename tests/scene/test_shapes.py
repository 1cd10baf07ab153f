"""Shapes refuse what is no solid, and pack what the distances read."""

import dataclasses

import numpy as np
import pytest

from rrnn_opt.errors import ProblemError
from rrnn_opt.scene import Box, Capsule, Cylinder, HalfSpace, Scene, Sphere

TURN = [0.0, 0.0, 0.6, 0.8]


@pytest.mark.parametrize(
    ("build", "field"),
    [
        (lambda: Box("b", [1, 0, 1]), "size[1]"),
        (lambda: Box("b", [1, 1, -1]), "size[2]"),
        (lambda: Box("b", [1, 1]), "size"),
        (lambda: Box("b", 1.0), "size"),
        (lambda: Box("b", [1, 1, float("nan")]), "size[2]"),
        (lambda: Box("b", [1, 1, True]), "size[2]"),
        (lambda: Box("b", [1, 1, 1e7]), "size[2]"),
        (lambda: Box("b", [1, 1, 10**400]), "size[2]"),
        (lambda: Box("", [1, 1, 1]), "name"),
        (lambda: Box("b", [1, 1, 1], [0, 0, float("inf")]), "position[2]"),
        (lambda: Box("b", [1, 1, 1], [0, 0, 0], [0, 0, 0, 0]), "quat_xyzw"),
        (lambda: Box("b", [1, 1, 1], [0, 0, 0], [0, 0, 0, 1.01]), "quat_xyzw"),
        (lambda: Cylinder("c", 0.0, 1.0), "radius"),
        (lambda: Cylinder("c", 1.0, 0.0), "length"),
        (lambda: Capsule("c", -1.0, 1.0), "radius"),
        (lambda: Capsule("c", 1.0, "1"), "length"),
        (lambda: Sphere("s", 0.0), "radius"),
        (lambda: Sphere("s", 1.0, np.zeros((3, 1))), "position"),
        (lambda: HalfSpace("h", [0, 0, 0], 0.0), "normal"),
        (lambda: HalfSpace("h", [0, 0, 2], 0.0), "normal"),
        (lambda: HalfSpace("h", [0, 0, 1], None), "offset"),
        (lambda: Scene((Box("b", [1, 1, 1]), {"type": "box"})), "obstacles[1]"),
    ],
)
def test_refused_with_the_name_of_the_field(build, field):
    with pytest.raises(ProblemError) as caught:
        build()
    assert caught.value.field == field
    assert "\n" not in str(caught.value)


def test_a_quaternion_nearly_of_unit_length_is_normalised():
    shape = Box("b", [1, 1, 1], [0, 0, 0], [0, 0, 0.6 * 1.0009, 0.8 * 1.0009])
    assert np.linalg.norm(shape.quat_xyzw) == pytest.approx(1, abs=1e-15)
    assert np.allclose(shape.quat_xyzw, TURN)
    with pytest.raises(ProblemError, match="quat_xyzw: must have unit length"):
        Box("b", [1, 1, 1], [0, 0, 0], [0, 0, 0.6 * 1.0011, 0.8 * 1.0011])


def test_a_normal_nearly_of_unit_length_keeps_the_solid_as_written():
    shape = HalfSpace("h", [0, 0, 1.0005], 2.0)
    assert np.array_equal(shape.normal, [0, 0, 1])
    assert shape.offset == 2.0 / 1.0005  # 1.0005 z <= 2


def test_packed_numbers():
    packed = Box("b", [2, 4, 6], [7, 8, 9], TURN).pack()
    first_column = [1 - 2 * 0.36, 2 * 0.6 * 0.8, 0]
    assert np.allclose(packed[:3], first_column, atol=1e-15)
    assert np.array_equal(packed[9:], [7, 8, 9, 1, 2, 3, 0])
    for shape in (Cylinder("c", 0.1, 0.5), Capsule("c", 0.1, 0.5)):
        assert np.array_equal(shape.pack()[9:], [0, 0, 0, 0.1, 0.25, 0, 0])
    assert np.array_equal(
        Sphere("s", 0.3, [1, 2, 3]).pack()[9:], [1, 2, 3, 0.3, 0, 0, 0]
    )
    packed = HalfSpace("h", [0.6, 0, 0.8], -0.2).pack()
    assert np.array_equal(packed[6:], [0.6, 0, 0.8, 0, 0, 0, -0.2, 0, 0, 0])


def test_scene_packs_by_kind_in_the_order_given():
    obstacles = (Sphere("a", 1.0), Box("b", [1, 1, 1]), Sphere("c", 2.0))
    scene = Scene(obstacles)
    packed = scene.pack()
    assert list(packed) == ["box", "cylinder", "capsule", "sphere", "halfspace"]
    assert [len(rows) for rows in packed.values()] == [1, 0, 0, 2, 0]
    assert all(rows.shape[1:] == (16,) for rows in packed.values())
    assert all(rows.flags.c_contiguous for rows in packed.values())
    assert list(packed["sphere"][:, 12]) == [1.0, 2.0]
    assert [o.name for o in scene.of_kind("sphere")] == ["a", "c"]
    assert (len(scene), tuple(scene)) == (3, obstacles)


def test_shapes_cannot_be_changed():
    given = np.array([1.0, 2.0, 3.0])
    shape = Box("b", given)
    given[0] = 99.0
    assert shape.size[0] == 1.0
    with pytest.raises(ValueError, match="read-only"):
        shape.size[0] = 2.0
    with pytest.raises(dataclasses.FrozenInstanceError):
        shape.size = given
