import copy

import numpy as np
import pytest

from rrnn_opt.errors import DocumentError, ProblemError
from rrnn_opt.simulation import Task

TEXT = """
[task]
kind = "circle"
radius = 0.15
plane = "yz"
through = "start"
period = 8.0
profile = "smooth"
duration = 16

[robot]
q0 = [0.0, 0.5, 0.0, 1.0, 0.0, 0.7, 0.0]
frame = "flange"

[control]
dt = 0.005
epsilon = 0.02
kappa = 20.0
law = "literal"
steps = 4

[noise]
enters = "acceleration"
sigma = 0.1
seed = 7
"""

DOCUMENT = {
    "task": {"kind": "circle", "radius": 0.1},
    "robot": {"q0": [0.0, 0.1, 0.2]},
    "control": {},
    "noise": {},
    "scene": {},
}


def test_every_field_is_read(tmp_path):
    path = tmp_path / "TASK.toml"
    path.write_text(TEXT)
    task = Task.load(path)
    curve, control, noise = task.curve, task.control, task.noise
    assert (curve.kind, curve.plane, curve.profile) == ("circle", "yz", "smooth")
    assert (curve.radius, curve.period, curve.duration) == (0.15, 8.0, 16.0)
    assert curve.centre is None
    assert task.frame == "flange"
    np.testing.assert_array_equal(task.q0, [0.0, 0.5, 0.0, 1.0, 0.0, 0.7, 0.0])
    assert (control.dt, control.epsilon, control.kappa) == (0.005, 0.02, 20.0)
    assert (control.law, control.steps) == ("literal", 4)
    assert (noise.enters, noise.sigma, noise.seed) == ("acceleration", 0.1, 7)
    assert task.steps == 3200


def test_defaults():
    task = Task.from_dict(DOCUMENT)
    assert task.curve.duration == task.curve.period == 10.0
    assert (task.control.dt, task.control.law, task.noise.sigma) == (
        0.01,
        "reduced",
        0.0,
    )
    assert task.frame is None


def test_noise_can_be_overridden():
    task = Task.from_dict(DOCUMENT).with_noise(0.3, seed=5)
    assert (task.noise.sigma, task.noise.seed) == (0.3, 5)
    assert task.with_noise(0.4).noise.seed == 5
    with pytest.raises(ProblemError, match=r"noise\.sigma"):
        task.with_noise(-1.0)


BAD = [
    ("task.kind", ("task", "kind"), "spiral"),
    ("task.kind", ("task", "kind"), ["circle"]),
    ("task.radius", ("task", "radius"), -0.1),
    ("task.radius", ("task", "radius"), float("nan")),
    ("task.radius", ("task", "radius"), None),
    ("task.plane", ("task", "plane"), "yy"),
    ("task.through", ("task", "through"), "end"),
    ("task.centre", ("task", "centre"), [0.0, 1.0]),
    ("task.period", ("task", "period"), 0.0),
    ("task.profile", ("task", "profile"), "bumpy"),
    ("task.duration", ("task", "duration"), 1e-9),
    ("task.duration", ("task", "duration"), 1e6),
    ("task.offset", ("task", "offset"), [0.0, 0.0, 0.0]),
    ("robot.q0[1]", ("robot", "q0"), [0.0, "x", 0.0]),
    ("robot.q0", ("robot", "q0"), 3.0),
    ("robot.frame", ("robot", "frame"), ""),
    ("control.dt", ("control", "dt"), 0),
    ("control.epsilon", ("control", "epsilon"), -1),
    ("control.kappa", ("control", "kappa"), -1),
    ("control.law", ("control", "law"), "fast"),
    ("control.steps", ("control", "steps"), 0),
    ("control.steps", ("control", "steps"), 1.5),
    ("control.gain", ("control", "gain"), 1.0),
    ("noise.enters", ("noise", "enters"), "torque"),
    ("noise.sigma", ("noise", "sigma"), -0.1),
    ("noise.seed", ("noise", "seed"), True),
    ("scene.contacts", ("scene", "contacts"), 3),
    ("scene.contacts[1]", ("scene", "contacts"), [0, -1]),
    ("scene.contacts[0]", ("scene", "contacts"), [True]),
    ("scene.obstacles", ("scene", "obstacles"), {}),
    ("scene.walls", ("scene", "walls"), []),
    ("control", ("control",), 5),
    ("task", ("task",), 5),
]


@pytest.mark.parametrize(("field", "where", "value"), BAD)
def test_the_wrong_field_is_named(field, where, value):
    document = copy.deepcopy(DOCUMENT)
    place = document
    for key in where[:-1]:
        place = place[key]
    if value is None:
        del place[where[-1]]
    else:
        place[where[-1]] = value
    # a very long task needs small steps to be too long
    if value == 1e6:
        document["control"]["dt"] = 1e-3
    with pytest.raises(ProblemError) as caught:
        Task.from_dict(document)
    assert caught.value.field == field


def test_centre_and_through_exclude_one_another():
    entry = {"kind": "circle", "radius": 0.1, "centre": [0, 0, 0], "through": "start"}
    with pytest.raises(ProblemError, match="not both"):
        Task.from_dict(DOCUMENT | {"task": entry})


@pytest.mark.parametrize("kind", ["line", "point"])
@pytest.mark.parametrize("given", [(), ("offset", "position")])
def test_a_line_needs_exactly_one_end(kind, given):
    entry = {"kind": kind} | {key: [0.1, 0.0, 0.0] for key in given}
    with pytest.raises(ProblemError, match="exactly one"):
        Task.from_dict(DOCUMENT | {"task": entry})


def test_a_file_that_cannot_be_read(tmp_path):
    with pytest.raises(DocumentError, match="cannot be read"):
        Task.load(tmp_path / "none.toml")
    (tmp_path / "bad.toml").write_text("[task\n")
    with pytest.raises(DocumentError, match="not TOML"):
        Task.load(tmp_path / "bad.toml")
    (tmp_path / "latin.toml").write_bytes(b"a = '\xff'")
    with pytest.raises(DocumentError, match="not UTF-8"):
        Task.load(tmp_path / "latin.toml")


@pytest.mark.parametrize("kind", ["line", "point"])
@pytest.mark.parametrize("key", ["offset", "position"])
def test_a_line_ends_where_it_is_told_to(kind, key):
    entry = {"kind": kind, key: [0.1, 0.0, -0.2]}
    curve = Task.from_dict(DOCUMENT | {"task": entry}).curve
    np.testing.assert_array_equal(getattr(curve, key), [0.1, 0.0, -0.2])
    assert getattr(curve, "offset" if key == "position" else "position") is None


def test_a_circle_may_have_its_centre_given():
    entry = {"kind": "circle", "radius": 0.1, "centre": [0.3, 0.0, 0.5]}
    curve = Task.from_dict(DOCUMENT | {"task": entry}).curve
    np.testing.assert_array_equal(curve.centre, [0.3, 0.0, 0.5])


def test_spheres_in_contact_are_listed():
    assert Task.from_dict(DOCUMENT | {"scene": {"contacts": [0, 4]}}).contacts == (0, 4)
    assert Task.from_dict(DOCUMENT).contacts is None


@pytest.mark.parametrize(
    ("text", "said"),
    [("a = " + "[" * 5000, "nested too deeply"), ("a = = 3", "is not TOML")],
)
def test_what_is_no_toml_is_told_of(tmp_path, text, said):
    path = tmp_path / "TASK.toml"
    path.write_text(text)
    with pytest.raises(DocumentError, match=said):
        Task.load(path)
