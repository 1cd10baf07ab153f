"""The demo's stages, on its own scene and on scenes that must go another way."""

import json

import pytest

from rrnn_opt import demo
from rrnn_opt.demo import truth
from rrnn_opt.demo.outcome import at_most, verdict


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    return demo.run(tmp_path_factory.mktemp("demo"), seed=0)


def test_every_check_passes_and_every_file_is_there(report):
    assert report.passed, [c for c in report.checks if not c.passed]
    names = {path.name for path in report.files}
    assert {"plan.json", "trajectory.csv", "plan.png", "plan.html"} <= names
    assert all(path.exists() for path in report.files)
    assert 1 <= len(report.rows) <= 10
    json.dumps(report.to_dict(), allow_nan=False)


def test_checks_can_fail():
    assert not at_most("x", float("nan"), 1.0).passed
    assert not at_most("x", 2.0, 1.0).passed
    assert not verdict("x", "UNKNOWN", "PROVED").passed


def test_the_moved_window_check_is_no_formality(report):
    """The same check on a scene with nothing near must not say REFUTED."""
    (path,) = (p for p in report.files if p.name == "plan.json")
    document = json.loads(path.read_text())
    document["problem"]["obstacles"] = [
        {"name": "far", "type": "sphere", "radius": 0.1, "position": [0.0, 0.0, 5.0]}
    ]
    assert not truth.check_checker(document).passed


def test_a_broken_law_does_not_pass_the_comparison(report, monkeypatch):
    """A network with half the target velocity settles elsewhere."""
    from rrnn_opt.planning import Problem, plan
    from rrnn_opt.scene.library import scenario

    problem = Problem.from_dict(scenario("plane").problem(0))
    result = plan(problem)
    written = demo.law.write_law(problem.robot)
    assert all(c.passed for c in truth.check_equilibria(written, result))
    broken = demo.law.write_law(problem.robot)
    wrong = demo.law.PrimalDual(epsilon=0.01)(
        demo.law.minimum_velocity(broken.kinematics, c=[0.3] * 7)
    )
    object.__setattr__(broken, "network", wrong)
    assert not all(c.passed for c in truth.check_equilibria(broken, result))
