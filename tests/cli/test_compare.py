import json

import pytest

from rrnn_opt.cli.main import main


@pytest.mark.slow
def test_a_comparison_from_the_command_line(tmp_path, capfd):
    study = tmp_path / "mine.py"
    study.write_text(
        "import numpy as np\n"
        "from qpsolvers import Problem\n"
        "def cases():\n"
        "    one = np.ones(2)\n"
        "    yield 'mine', [Problem(np.eye(2), k * one, lb=-one, ub=one)"
        " for k in range(3)]\n"
    )
    words = ["compare", str(study), "--solvers", "daqp,osqp", "--passes", "2"]
    words += ["--out", str(tmp_path / "out"), "--json"]
    assert main(words) == 0
    shown = capfd.readouterr()
    assert "6 cases (solvers: 2, sets: 1, passes: 2)" in shown.err
    assert "--resume goes on there" in shown.err
    first = json.loads(shown.out)
    modes = {(row["solver"], row["mode"]) for row in first["rows"]}
    assert modes == {
        (s, m) for s in ("daqp", "osqp") for m in ("cold", "warm", "stream")
    }
    for row in first["rows"]:
        assert {"stream", "n", "solved", "wilson", "primal", "dual", "gap"} <= set(row)
        assert {"p50", "p95", "p999", "max"} <= set(row["time_us"])
        assert row["solved"] == row["n"] == 3
    assert main([*words, "--resume"]) == 0
    assert json.loads(capfd.readouterr().out)["rows"] == first["rows"]


def test_what_there_is_to_compare(capfd):
    assert main(["compare", "--list", "--json"]) == 0
    listed = json.loads(capfd.readouterr().out)
    assert "circle/pa10" in listed["studies"]["circle"]
    by_name = {one["name"]: one for one in listed["solvers"]}
    assert by_name["daqp"]["licence"] == "MIT"


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ([], "name a study: rrnn compare quick --solvers"),
        (["circles"], "no study 'circles'"),
        (["circle", "--solvers", "qp"], "no solver 'qp'"),
        (["nothing.py"], "cannot be read"),
        pytest.param(
            ["circle", "--dask", "tcp://127.0.0.1:9"],
            "no Dask cluster",
            marks=pytest.mark.slow,
        ),
    ],
)
def test_wrong_words_are_said_in_one_sentence(
    words, sentence, tmp_path, capfd, monkeypatch
):
    pytest.importorskip("distributed", reason="distributed is not installed")
    monkeypatch.setattr("rrnn_opt.study.cluster.PATIENCE_S", 0.5)
    monkeypatch.chdir(tmp_path)
    assert main(["compare", *words]) == 2
    assert sentence in capfd.readouterr().err


def test_whoever_asks_everybody_is_told_a_shorter_way():
    from types import SimpleNamespace

    from rrnn_opt.cli.compare import intended

    def told(cases, solvers):
        args = SimpleNamespace(passes=5, solvers=solvers, dask=None)
        study = type("S", (list,), {"solvers": [1], "sets": [1]})(range(cases))
        return "\n".join(intended(args, study, "runs/x"))

    assert "--solvers osqp,daqp,rrnn is the quick way" in told(100, None)
    assert "quick way" not in told(10, None) + told(100, "daqp")
