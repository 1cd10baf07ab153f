import json
from pathlib import Path

import pytest

from rrnn_opt.cli.main import main
from rrnn_opt.cli.probe import probe, try_solver

TASK = """
[task]
kind = "circle"
radius = 0.05
plane = "yz"
through = "start"
period = 1.0
duration = 0.5
[robot]
q0 = [0.0, 0.5, 0.0, 1.2, 0.0, 0.7, 0.0]
[control]
dt = 0.01
kappa = 10.0
[noise]
sigma = 0.3
seed = 5
"""


@pytest.fixture(autouse=True)
def here(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)


def document(capfd) -> dict:
    shown = capfd.readouterr().out
    assert shown.count("\n") == 1
    return json.loads(shown)


def test_robots_names_limits_source_and_licence(capfd):
    assert main(["robots", "--json"]) == 0
    robots = {r["name"]: r for r in document(capfd)["robots"]}
    assert set(robots) == {"pa10", "panda", "raven2", "planar3"}
    assert robots["panda"]["spheres"] == 59
    assert robots["pa10"]["limits"]["velocity"][0] == 1.0
    assert all(r["source"] and r["licence"] for r in robots.values())
    assert main(["robots", "planar3"]) == 0
    assert "licence" in capfd.readouterr().out


def test_robots_tells_what_is_read_from_a_file(capfd):
    urdf = Path(__file__).parents[2] / "examples" / "planar_arm.urdf"
    assert main(["robots", str(urdf), "--json"]) == 0
    (robot,) = document(capfd)["robots"]
    assert (robot["dof"], robot["tip"]) == (2, "tip")
    assert "acceleration limit" in robot["source"]
    assert main(["robots", str(urdf)]) == 0
    assert "not stated" in capfd.readouterr().out


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["plna", "x.json"], "no command is called 'plna'; did you mean 'plan'?"),
        (["plan", "--wat", "x.json"], "--wat (see rrnn plan --help)"),
        (["robots", "pa11"], "did you mean 'pa10'?"),
    ],
)
def test_a_slip_of_the_finger_is_answered_with_the_right_word(words, told, capfd):
    assert main(words) == 2
    assert told in capfd.readouterr().err


def test_doctor_says_what_works(capfd):
    assert main(["doctor", "--json"]) == 0
    report = document(capfd)
    works = {s["name"] for s in report["solvers"] if s["solves"]}
    assert {"osqp", "daqp"} <= works
    assert report["compiler"]["command"]
    assert report["cache"]["writable"]


def test_a_solver_that_dies_takes_only_its_own_process(monkeypatch):
    assert try_solver("daqp")["solves"]
    assert not try_solver("no such solver")["solves"]
    daqp, gone, osqp = probe(["daqp", "no such solver", "osqp"])
    assert daqp["solves"]
    assert osqp["notices_infeasible"]
    assert not gone["solves"]
    late = probe(["daqp", "osqp"], patience=0.01)
    assert [r["message"] for r in late] == ["no answer in time"] * 2


def test_simulate_writes_curve_picture_and_metrics(capfd, tmp_path):
    (tmp_path / "t.toml").write_text(TASK)
    words = ["simulate", "minimum_velocity", "--robot", "pa10", "--task", "t.toml"]
    assert main([*words, "--json", "--out", "s"]) == 0
    metrics = document(capfd)
    assert metrics["steps"] == 50
    assert metrics["seed"] == 5
    assert json.loads((tmp_path / "s" / "metrics.json").read_text()) == metrics
    names = {"simulation.csv", "simulation.png", "metrics.json"}
    assert {p.name for p in (tmp_path / "s").iterdir()} == names
    assert main([*words, "--json", "--noise", "0", "--seed", "1"]) == 0
    quiet = document(capfd)
    assert quiet["seed"] == 1
    assert quiet["rms_error_m"] < metrics["rms_error_m"]


def test_simulate_takes_any_network_and_obstacles(capfd, tmp_path):
    obstacle = """
[scene]
contacts = [42]
[[scene.obstacles]]
type = "sphere"
radius = 0.05
position = [0.9, 0.4, 0.9]
"""
    (tmp_path / "t.toml").write_text(TASK.replace("kappa = 10.0", "") + obstacle)
    words = ["simulate", "method1", "--robot", "pa10", "--task", "t.toml", "--json"]
    assert main(words) == 0
    usual = document(capfd)
    assert usual["scheme"] == "primal_dual_method1"
    assert usual["least_clearance_m"] > 0.0
    assert main([*words, "--network", "DualNetwork"]) == 0
    dual = document(capfd)
    assert dual["scheme"] == "dual_network_method1"
    assert dual["rms_error_m"] == pytest.approx(usual["rms_error_m"], rel=1e-4)
    assert main([*words, "--network", "DualNetwrk"]) == 2
    assert "did you mean 'DualNetwork'" in document(capfd)["error"]["message"]


def test_generate_prints_the_manifest_of_what_it_wrote(capfd, tmp_path):
    words = ["generate", "position_feedback", "--robot", "planar3", "--out", "g"]
    assert main([*words, "--json", "--prefix", "mine"]) == 0
    manifest = document(capfd)
    folder = tmp_path / "g" / "mine"
    assert json.loads((folder / "MANIFEST.json").read_text()) == manifest
    assert (folder / "src" / "mine.c").is_file()
    robot = manifest["robot"]
    assert robot["name"] == "planar3"
    assert robot["frame"] == "tip"
    told = (folder / "README.md").read_text()
    joints = ", ".join(f"`{name}`" for name in robot["joints"])
    assert f"Joints stand in this order: {joints}. The frame is `tip`" in told


def test_verify_settles_and_its_certificate_can_be_checked(capfd, tmp_path):
    assert main(["verify", "C18", "--json", "--out", "v"]) == 0
    (row,) = document(capfd)["claims"]
    assert row["verdict"] == "PROVED"
    assert main(["check", row["certificate"], "--json"]) == 0
    assert document(capfd)["status"] == "PROVED"
    altered = json.loads((tmp_path / row["certificate"]).read_text())
    altered["claim"]["tape"][-1][0] = "input"
    (tmp_path / "altered.json").write_text(json.dumps(altered))
    assert main(["check", "altered.json", "--json"]) in (1, 2)


def test_check_and_view_of_a_plan_that_was_tampered_with(capfd, tmp_path):
    problem = {
        "robot": "planar3",
        "start": [0.0, 0.5, 0.5],
        "goal": {"joints": [1.0, 0.2, -0.4]},
        "obstacles": [],
    }
    (tmp_path / "p.json").write_text(json.dumps(problem))
    assert main(["plan", "p.json", "--json"]) == 0
    plan = document(capfd)
    (tmp_path / "plan.json").write_text(json.dumps(plan))
    assert main(["check", "plan.json"]) == 0
    assert capfd.readouterr().err == ""
    plan["robot"]["spheres"][0]["radius"] /= 2
    (tmp_path / "plan.json").write_text(json.dumps(plan))
    assert main(["check", "plan.json"]) == 0  # it holds for this other robot
    assert "not the built-in planar3" in capfd.readouterr().err
    plan["trajectory"]["q"][1][0] += 0.05
    (tmp_path / "plan.json").write_text(json.dumps(plan))
    assert main(["check", "plan.json", "--json"]) == 1
    assert document(capfd)["holds"] is False
    assert main(["check", "plan.json"]) == 1
    assert "FAIL" in capfd.readouterr().out
    assert main(["view", "plan.json", "--json"]) == 0
    page = document(capfd)["page"]
    assert (tmp_path / page).read_text("utf-8").startswith("<!doctype html>")
