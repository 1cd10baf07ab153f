"""Files of points that are none get a sentence, and pipes are not waited for."""

from __future__ import annotations

import io
import os

import numpy as np
import pytest

from rrnn_opt.check.plans.solids.files import read_points
from rrnn_opt.errors import DocumentError

POINTS = np.arange(12.0).reshape(4, 3)


def npy(array, version=(1, 0)) -> bytes:
    file = io.BytesIO()
    np.lib.format.write_array(file, array, version=version, allow_pickle=True)
    return file.getvalue()


def read(tmp_path, raw, suffix=".npy", **more):
    path = tmp_path / f"p{suffix}"
    path.write_bytes(raw)
    return read_points({"path": str(path), **more}, "obstacles[0]")


@pytest.mark.parametrize("version", [(1, 0), (2, 0), (3, 0)])
@pytest.mark.parametrize("order", ["C", "F"])
def test_every_version_and_order_of_the_format(tmp_path, version, order):
    found = read(tmp_path, npy(np.array(POINTS, order=order), version))
    np.testing.assert_array_equal(found, POINTS)


@pytest.mark.parametrize(
    "raw",
    [
        b"",
        b"\x93NUMPY",
        b"\x93NUMPY\x01\x00",
        b"\x93NUMPY\x01\x00\xff\xff{",
        npy(POINTS)[:-8],
        npy(POINTS).replace(b"'<f8'", b"'<q9'"),
        npy(POINTS).replace(b"(4, 3)", b"(9, 3)"),
        npy(POINTS).replace(b"(4, 3)", b"'a', 3"),
        npy(POINTS).replace(b"descr", b"dxscr"),
        npy(np.array([None, {}])),
        npy(np.full((4, 3), np.inf)),
        npy(POINTS[0]),
    ],
)
def test_what_is_no_array_of_points_is_refused(tmp_path, raw):
    with pytest.raises(DocumentError, match=r"obstacles\[0\]\.path"):
        read(tmp_path, raw)


@pytest.mark.parametrize("suffix", [".csv", ".stl", ".obj", ".xyz", ""])
@pytest.mark.parametrize("raw", [b"", b"\xff\xfe", b"v 1 2\n", b"1,2\n", b"solid\n"])
def test_no_other_file_is_taken_for_points(tmp_path, suffix, raw):
    with pytest.raises(DocumentError, match=r"obstacles\[0\]\.path"):
        read(tmp_path, raw, suffix)


def test_a_file_that_was_changed_is_refused(tmp_path):
    with pytest.raises(DocumentError, match="has changed since the plan"):
        read(tmp_path, npy(POINTS), sha256="00")


def test_pipes_devices_and_folders_are_not_read(tmp_path):
    os.mkfifo(tmp_path / "pipe.npy")
    (tmp_path / "folder.npy").mkdir()
    (tmp_path / "zero.npy").symlink_to("/dev/zero")
    (tmp_path / "loop.npy").symlink_to("loop.npy")
    with (tmp_path / "huge.npy").open("wb") as file:
        file.truncate(2**40)
    for path in tmp_path.iterdir():
        with pytest.raises(DocumentError, match="is unreadable"):
            read_points({"path": str(path)}, "obstacles[0]")
