"""The soak sees what is wrong, and goes on where it stopped."""

import json

import pytest

from benchmarks.follow import ends_error, follow, sampled
from benchmarks.soak import run as soak
from benchmarks.soak.scenes import benchmark, shipped
from rrnn_opt.planning import Problem, plan
from rrnn_opt.scene.library import scenario

KINDS = {"window": shipped("window"), "mbm": benchmark}


@pytest.fixture(scope="module")
def document():
    return plan(Problem.from_dict(scenario("window_050").problem(3)), seed=3).to_dict()


def changed(document, **trajectory):
    return {**document, "trajectory": {**document["trajectory"], **trajectory}}


def test_a_good_plan_breaks_nothing():
    row = soak.judged(0, KINDS)
    assert (row["kind"], row["status"], row["broken"]) == ("window", "solved", [])
    assert row["least_m"] > 0.0
    assert row["dense_m"] is None
    assert soak.judged(1, KINDS)["kind"] == "mbm"


def test_advancement_finds_no_more_room_than_dense_samples(document):
    walked = follow(document)
    assert walked.floored == 0
    assert abs(walked.least - sampled(document, 2e-3)) < 1e-3


def test_every_broken_promise_is_told(document):
    through = {"name": "pin", "type": "sphere", "radius": 0.01}
    through["position"] = document["problem"]["goal"]["position"]
    problem = document["problem"]
    hit = {**problem, "obstacles": [*problem["obstacles"], through]}
    told = soak._followed({**document, "problem": hit}, dense=False)["broken"]
    assert told == ["collision", "clearance"]
    fast = [[2.0 * v for v in row] for row in document["trajectory"]["qd"]]
    told = soak._followed(changed(document, qd=fast), dense=False)["broken"]
    assert "limits" in told
    elsewhere = {**problem, "start": [q + 1e-9 for q in problem["start"]]}
    told = soak._followed({**document, "problem": elsewhere}, dense=False)["broken"]
    assert told == ["start"]
    short = {k: v[:-20] for k, v in document["trajectory"].items() if k != "duration"}
    assert ends_error({**document, "trajectory": short})[1] > 1.0


def test_a_stopped_run_goes_on(tmp_path, monkeypatch):
    monkeypatch.setattr(soak, "makers", lambda folder: KINDS)
    assert soak.main(["--plans", "2", "--out", str(tmp_path)]) == 0
    file = tmp_path / "rows.0.jsonl"
    first = file.read_text("utf-8")
    file.write_text(first + '{"n": 2, "kin', "utf-8")  # killed while writing
    assert len(soak.rows(tmp_path)) == 2
    file.write_text(first + '{"n": 2, "kin\n', "utf-8")
    assert soak.main(["--plans", "3", "--out", str(tmp_path)]) == 0
    again = [json.loads(line) for line in first.splitlines()]
    assert soak.rows(tmp_path)[:2] == again
    assert [row["n"] for row in soak.rows(tmp_path)] == [0, 1, 2]
    table = (tmp_path / "soak.md").read_text("utf-8")
    assert "| all | 3 | 3 |" in table
    assert ", process 0, 3 plans: " in table


def test_every_hundredth_motion_is_sampled_too(monkeypatch):
    monkeypatch.setattr(soak, "DENSE", 1)
    monkeypatch.setattr(soak, "sampled", lambda document: -1e-3)
    assert soak.judged(0, KINDS)["broken"] == ["collision", "clearance"]


def test_a_run_that_only_plans_claims_to_have_followed_nothing(tmp_path, monkeypatch):
    monkeypatch.setattr(soak, "makers", lambda folder: KINDS)
    words = ["--plans", "1", "--plan-only", "--time-limit", "5", "--out", str(tmp_path)]
    assert soak.main(words) == 0
    assert "least_m" not in soak.rows(tmp_path)[0]
    assert "No trajectory was followed" in (tmp_path / "soak.md").read_text("utf-8")
