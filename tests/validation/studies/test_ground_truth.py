import csv
import json

import pytest

from rrnn_opt.errors import RrnnError
from rrnn_opt.study import generator
from rrnn_opt.validation.studies.catalogue import network_rules, schemes
from rrnn_opt.validation.studies.documents import pairs
from rrnn_opt.validation.studies.ground_truth import SOLVERS, GroundTruth, main
from rrnn_opt.validation.studies.infeasible import Infeasible

SLICE = ("minimum_velocity", "clearance_rows", "gradient_projection")
NETWORKS = ("PrimalDual", "LviPdnn", "Hildreth", "Znn")


def measured(study):
    return [study.measure(case, generator(case)) for case in study]


def test_a_slice_agrees_with_the_solvers():
    """All networks of the slice are right, and with what they were asked for."""
    table = pairs(measured(GroundTruth(("planar3",), 15, 15, SLICE, NETWORKS)))
    networks = [row for row in table if row["kind"] == "network"]
    assert {row["who"] for row in networks} == set(NETWORKS)
    assert len(networks) == 3 + 3 + 3 + 1
    for row in networks:
        assert row["n"] == row["right"] == 15
        assert row["truth_primal"] <= 1e-6
        assert row["truth_dual"] <= 1e-6
        assert row["well"] >= 10
    daqp = [row for row in table if row["who"] == "daqp"]
    assert all(row["right"] == row["n"] for row in daqp)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("robot", "part"),
    [
        ("pa10", slice(None)),
        ("panda", slice(0, None, 3)),
        ("raven2", slice(1, None, 3)),
        ("planar3", slice(2, None, 3)),
    ],
)
def test_every_pair_and_each_scheme_on_another_robot(robot, part):
    """No wrong answer anywhere; few without one (at most 4.2 %, on raven2)."""
    chosen = tuple(s.name for s in schemes())[part]
    study = GroundTruth((robot,), 12, 12, chosen)
    table = pairs(measured(study))
    networks = [row for row in table if row["kind"] == "network"]
    assert {row["scheme"] for row in networks} == set(chosen)
    asked = sum(row["n"] for row in networks)
    wrong = [(r["who"], r["scheme"]) for r in networks if "solved" in r["statuses"]]
    assert wrong == []
    assert sum(row["right"] for row in networks) >= 0.9 * asked
    ran, known = {row["who"] for row in networks}, set(network_rules())
    assert ran <= known
    assert ran == known or part != slice(None)  # some take equalities alone


def test_the_least_shares_of_active_points_hold():
    study = GroundTruth(("pa10",), 20, 20, ("method1", "task_augmentation"), ("Znn",))
    for row in measured(study):
        points = row["points"]
        assert points["bound"] >= points["n"] / 3
        assert points["contact"] >= points["n"] / 10


def test_a_wrong_answer_is_seen(monkeypatch):
    """A network whose answer is moved is counted wrong, its neighbours are not."""
    from rrnn_opt.validation.studies import block

    honest = block.settle_at

    def moved(network, *args, **kwargs):
        x, info = honest(network, *args, **kwargs)
        shift = 1e-5 if network.name.startswith("lvi") else 0.0
        return None if x is None else x + shift, info

    monkeypatch.setattr(block, "settle_at", moved)
    study = GroundTruth(
        ("planar3",), 6, 6, ("minimum_velocity",), ("LviPdnn", "PrimalDual")
    )
    by_name = {row["who"]: row for row in pairs(measured(study))}
    assert by_name["LviPdnn"]["right"] == 0
    assert by_name["LviPdnn"]["apart"]["daqp"] >= 4
    assert by_name["LviPdnn"]["statuses"] == {"solved": 6}
    assert by_name["PrimalDual"]["right"] == 6
    assert by_name["daqp"]["right"] == 6


def test_a_network_that_gives_no_point_is_counted(monkeypatch):
    from rrnn_opt.solving import Status
    from rrnn_opt.validation.studies import block

    class Info:
        status = Status.MAX_ITER

    monkeypatch.setattr(block, "settle_at", lambda *args, **kwargs: (None, Info))
    study = GroundTruth(("planar3",), 3, 3, ("position_feedback",), ("PrimalDual",))
    by_name = {row["who"]: row for row in pairs(measured(study))}
    assert by_name["PrimalDual"]["answered"] == 0
    assert by_name["PrimalDual"]["statuses"] == {"max_iter": 3}
    assert by_name["PrimalDual"]["examples"][0] == "planar3/position_feedback/0+0"


def test_infeasible_programmes_are_known_as_such_whatever_a_solver_hands_out():
    (row,) = measured(Infeasible(("planar3",), 5))
    said = row["infeasible"]
    assert said["osqp"]["x junk"] == 5
    for name in (*SOLVERS, "PrimalDual", "LviPdnn", "Hildreth"):
        assert said[name]["not found"] == 5
        assert said[name]["judged primal_infeasible"] == 5
    for name in ("PrimalDual", "LviPdnn", "Hildreth"):
        assert said[name]["x none"] == 5


def test_the_command_writes_tables_and_takes_up_where_it_stopped(tmp_path, capsys):
    words = ["--points", "4", "--block", "2", "--infeasible", "1", "--robots"]
    words += ["planar3", "--networks", "PrimalDual", "--out", str(tmp_path)]
    first = [*words, "--schemes", "position_feedback"]
    assert main(first) == 0
    assert capsys.readouterr().err.splitlines() == [
        "infeasible/planar3",
        "planar3/position_feedback/0",
        "planar3/position_feedback/2",
    ]
    more = [*first[:1], "6", *first[2:]]
    assert main(more) == 0
    told = capsys.readouterr()
    assert told.err.splitlines() == ["planar3/position_feedback/4"]
    assert told.out.strip() == str(tmp_path / "ground_truth.md")
    (tmp_path / "ground_truth.md").unlink()
    assert main([*words, "--schemes", "position_feedback", "slide", "--finished"]) == 0
    assert capsys.readouterr().err == ""
    page = (tmp_path / "ground_truth.md").read_text()
    assert "| PrimalDual | planar3 | 4 | 100.00 % |" in page
    assert "junk 1" in page
    with (tmp_path / "ground_truth.csv").open() as file:
        table = list(csv.DictReader(file))
    assert [row["who"] for row in table] == [*SOLVERS, "PrimalDual"]
    data = json.loads((tmp_path / "ground_truth.json").read_text())
    assert len(data["pairs"]) == 5


def test_unknown_names_are_said(tmp_path, capsys):
    out = ["--out", str(tmp_path)]
    assert main([*out, "--schemes", "nothing"]) == 2
    assert "no scheme 'nothing'" in capsys.readouterr().err
    with pytest.raises(RrnnError, match="no network 'None'"):
        GroundTruth(networks=("None",))
