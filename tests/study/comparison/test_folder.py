"""A folder of saved QPs becomes one set; what is no QP is said in one sentence."""

import pickle

import numpy as np
import pytest
from qpsolvers import Problem

from rrnn_opt.errors import RrnnError
from rrnn_opt.study.comparison import is_own, own_sets

ONE = np.ones(2)


def save(folder, name, **parts):
    folder.mkdir(exist_ok=True)
    np.savez(folder / name, **parts)


def test_problems_as_qpsolvers_saves_them(tmp_path):
    folder = tmp_path / "mine"
    folder.mkdir()
    rows = np.array([[1.0, 2.0]])
    for k in range(3):
        made = Problem(np.eye(2), k * ONE, rows, ONE[:1], lb=-ONE)
        made.save(str(folder / f"{k}.npz"))
    ((name, found),) = own_sets(str(folder)).items()
    assert name == "mine"
    assert found.sequence
    assert len(found) == 3
    last = found.instances[2].problem
    np.testing.assert_array_equal(last.q, 2 * ONE)
    np.testing.assert_array_equal(last.G, rows)
    assert last.A is None
    assert last.ub is None


def test_arrays_that_are_left_out_are_none(tmp_path):
    save(tmp_path / "mine", "a.npz", P=np.eye(2), q=ONE)
    (found,) = own_sets(str(tmp_path / "mine")).values()
    assert found.instances[0].problem.G is None


@pytest.mark.parametrize(
    ("parts", "sentence"),
    [
        ({"q": ONE}, "needs P and q"),
        ({"P": np.eye(2), "q": ONE, "G": np.ones((2, 1)), "h": ONE}, "needs 2 columns"),
        ({"P": np.eye(2), "q": ONE, "h": ONE}, "G must hold 2 rows"),
        ({"P": np.eye(2), "q": ONE * np.nan}, "q must be a list of finite numbers"),
    ],
)
def test_what_is_no_programme(tmp_path, parts, sentence):
    save(tmp_path / "mine", "bad.npz", **parts)
    with pytest.raises(RrnnError, match=sentence) as caught:
        own_sets(str(tmp_path / "mine"))
    assert "bad.npz" in str(caught.value)


class Trap:
    def __reduce__(self):
        return (pytest.fail, ("a pickle was loaded",))


def test_no_pickle_is_ever_loaded(tmp_path):
    trap = np.array([Trap()], dtype=object)
    save(tmp_path / "mine", "trap.npz", P=trap, q=ONE)
    with pytest.raises(RrnnError, match="needs P and q"):
        own_sets(str(tmp_path / "mine"))
    (tmp_path / "mine" / "trap.npz").write_bytes(pickle.dumps(ONE))
    with pytest.raises(RrnnError, match=r"is no \.npz file"):
        own_sets(str(tmp_path / "mine"))


def test_a_folder_without_problems(tmp_path):
    with pytest.raises(RrnnError, match=r"holds no \.npz files"):
        own_sets(str(tmp_path))


def test_our_own_names_come_before_folders(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("quick", "mine"):
        (tmp_path / name).mkdir()
    assert not is_own("quick")
    assert is_own("mine")
    assert is_own("./quick")
    assert is_own("lost.py")
    assert not is_own("lost")
