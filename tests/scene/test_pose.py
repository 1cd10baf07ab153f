"""Quaternions and matrices, against pinocchio and the group laws."""

import numpy as np
import pinocchio as pin
import pytest

from rrnn_opt.scene.pose import (
    IDENTITY,
    frame_around,
    matrix_from_quaternion,
    quaternion_from_matrix,
)


def quaternions():
    rng = np.random.default_rng(1)
    random = rng.normal(size=(200, 4))
    # half turns and nearly half turns: the hard cases of the way back
    half = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0.6, 0.8, 0, 1e-9]]
    every = np.vstack([random, half, [IDENTITY]])
    return every / np.linalg.norm(every, axis=1, keepdims=True)


def test_matrix_agrees_with_pinocchio():
    for q in quaternions():
        expected = pin.Quaternion(q[3], q[0], q[1], q[2]).matrix()
        assert np.allclose(matrix_from_quaternion(q), expected, atol=1e-15)


def test_back_again():
    for q in quaternions():
        back = quaternion_from_matrix(matrix_from_quaternion(q))
        assert back[3] >= 0
        assert min(np.abs(back - q).max(), np.abs(back + q).max()) < 1e-14


def test_matrix_is_a_rotation_even_if_the_quaternion_is_not_of_unit_length():
    for q in quaternions():
        r = matrix_from_quaternion(1.0005 * q)
        assert np.allclose(r @ r.T, np.eye(3), atol=1e-14)
        assert np.linalg.det(r) == pytest.approx(1)


@pytest.mark.parametrize("normal", [[0, 0, 1], [0, 0, -1], [1, 0, 0], [0.6, 0, 0.8]])
def test_frame_around_a_normal(normal):
    frame = frame_around(normal)
    assert np.array_equal(frame[:, 2], normal)
    assert np.allclose(frame @ frame.T, np.eye(3), atol=1e-15)
    assert np.linalg.det(frame) == pytest.approx(1)
