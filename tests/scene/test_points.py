"""Clouds: what is read, measured against scipy, and what is refused."""

import numpy as np
import pytest
from scipy.spatial import cKDTree

from rrnn_opt.errors import ProblemError
from rrnn_opt.scene import Points
from rrnn_opt.scene.points import MOST
from tests.check.plans.one_solid import OneSolid


@pytest.mark.parametrize("suffix", ["npy", "csv", "named.csv"])
def test_clouds_are_read_and_measured(tmp_path, suffix):
    points = np.random.default_rng(1).uniform(-1, 1, (3000, 3))
    path = tmp_path / f"cloud.{suffix}"
    if suffix == "npy":
        np.save(path, points)
    else:
        header = "x,y,z" if suffix == "named.csv" else ""
        np.savetxt(path, points, delimiter=",", header=header, comments="", fmt="%.17g")
    cloud = Points("cloud", str(path), 0.01)
    np.testing.assert_array_equal(cloud.centers, points)
    looked = np.random.default_rng(5).uniform(-1.5, 1.5, (300, 3))
    want = cKDTree(points).query(looked)[0] - 0.01
    found = OneSolid(cloud.to_dict()).distance(looked)
    np.testing.assert_allclose(found, want, atol=1e-12)


@pytest.mark.parametrize(
    "points", [np.zeros((3, 2)), np.zeros((0, 3)), np.full((2, 3), np.nan)]
)
def test_clouds_that_are_none_are_refused(tmp_path, points):
    np.save(tmp_path / "p.npy", points)
    with pytest.raises(ProblemError, match=r"p\.npy"):
        Points("p", str(tmp_path / "p.npy"), 0.1)


def npy(header, body=b"", version=b"\x01\x00"):
    text = header.encode() + b"\n"
    size = len(text).to_bytes(2, "little")
    return b"\x93NUMPY" + version + size + text + body


NINE = "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 3)}"


@pytest.mark.parametrize(
    ("name", "raw", "said"),
    [
        ("p.npy", npy(NINE, bytes(72), b"\x09\x00"), "version"),
        ("p.npy", npy(NINE, bytes(71)), "its length is not that of"),
        ("p.npy", npy(NINE.replace("<f8", "|O"), bytes(72)), "it holds object"),
        ("p.npy", npy(NINE.replace("<f8", "|S8"), bytes(72)), "not numbers"),
        ("p.npy", npy(NINE.replace("(3, 3)", "(3, 1000000000)")), "its length"),
        ("p.npy", npy("{'descr': ("), "cannot be read"),
        ("p.csv", b"x,y,z\n0,0,0\n1,2,three\n", "three"),
        ("p.csv", b"0,0,0\n1,2\n", "cannot be read"),
        ("p.csv", b"0,0,0\n\xff\xfe\n", "cannot be read"),
        ("p.csv", b"0,0,0\n" * (MOST + 1), "more than"),
        ("p.csv", b"", "holds 0 points"),
    ],
)
def test_a_file_of_points_that_cannot_be_read_is_told_of(tmp_path, name, raw, said):
    (tmp_path / name).write_bytes(raw)
    with pytest.raises(ProblemError, match=said) as caught:
        Points("p", str(tmp_path / name), 0.1)
    assert caught.value.field == "path"


def test_a_newer_header_and_a_line_of_names_are_read(tmp_path):
    points = np.arange(6.0).reshape(2, 3)
    with (tmp_path / "p.npy").open("wb") as file:
        np.lib.format.write_array(file, points, version=(2, 0))
    (tmp_path / "p.csv").write_text("x,y,z\n0,1,2\n\n3,4,5\n")
    for name in ("p.npy", "p.csv"):
        read = Points("p", str(tmp_path / name), 0.1).centers
        np.testing.assert_array_equal(read, points)
        assert not read.flags.writeable


def test_a_cloud_whose_header_is_cut_is_refused(tmp_path):
    np.save(tmp_path / "p.npy", np.zeros((3, 3)))
    whole = (tmp_path / "p.npy").read_bytes()
    (tmp_path / "p.npy").write_bytes(whole.replace(b"}", b" "))
    with pytest.raises(ProblemError, match=r"p\.npy cannot be read"):
        Points("p", str(tmp_path / "p.npy"), 0.1)
