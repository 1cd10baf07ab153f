import io

import numpy as np
import pytest
from PIL import Image

from rrnn_opt.errors import DocumentError
from rrnn_opt.report.plan.picture import draw_plan, picture


def pixels(document: dict) -> np.ndarray:
    return np.asarray(Image.open(io.BytesIO(picture(document))).convert("RGB"), int)


def share(image: np.ndarray, bright: int, dark: int, by: int) -> float:
    """Share of the scene's pixels in which one channel exceeds another."""
    scene = image[: int(0.94 * image.shape[0]), : int(0.62 * image.shape[1])]
    return float(np.mean(scene[..., bright] - scene[..., dark] > by))


def test_robot_obstacle_and_target_are_in_the_picture(window):
    red, green, blue = range(3)
    full = pixels(window)
    bare = pixels({**window, "problem": {**window["problem"], "obstacles": []}})
    assert share(full, blue, red, 60) > 0.01  # the arm at its end
    wall = share(full, red, blue, 30) - share(bare, red, blue, 30)
    assert wall > 0.05
    aimless = {**window["problem"], "goal": {"joints": window["path"][-1]}}
    without = pixels({**window, "problem": aimless})
    assert share(full, red, green, 120) > share(without, red, green, 120)


def test_every_kind_of_shape_and_no_trajectory_can_be_drawn(every_shape, tmp_path):
    draw_plan(every_shape, tmp_path / "a.png")
    bare = {**every_shape, "trajectory": None, "path": None, "certificate": None}
    draw_plan({**bare, "stats": {}}, tmp_path / "b.png")
    with Image.open(tmp_path / "a.png") as a, Image.open(tmp_path / "b.png") as b:
        assert a.size == b.size
        assert np.asarray(b.convert("L")).min() < 100  # the robot is there


@pytest.mark.slow
def test_the_same_document_gives_the_same_picture(every_shape):
    assert picture(every_shape) == picture(every_shape)


@pytest.mark.parametrize(
    "broken",
    [
        {"status": "invalid_problem"},
        {"robot": {}, "problem": {}},
        {"robot": {"parents": [-1]}, "problem": {"start": ["x"]}},
    ],
)
def test_what_is_no_plan_is_refused_in_one_sentence(broken):
    with pytest.raises(DocumentError):
        picture(broken)


@pytest.mark.slow
def test_names_of_a_document_are_not_read_as_formulas(every_shape):
    every_shape["robot"]["name"] = "a_$b^{$"
    every_shape["robot"]["joint_names"] = ["$x", "_y", "z$"]
    assert picture(every_shape)[:4] == b"\x89PNG"


def test_names_that_no_font_has_are_drawn_somehow(every_shape):
    names = ["\ud800", "a\0b", "$\\frac{", "機\u202ex", "x" * 3000]
    box = {"size": [1.0] * 3, "position": [9.0] * 3}
    document = {
        **every_shape,
        "robot": {**every_shape["robot"], "name": "".join(names)},
    }
    obstacles = [{"name": name, "type": "box", **box} for name in names]
    obstacles += [{"name": "odd", "type": name, **box} for name in names]
    document["problem"] = {**every_shape["problem"], "obstacles": obstacles}
    assert picture(document).startswith(b"\x89PNG")
