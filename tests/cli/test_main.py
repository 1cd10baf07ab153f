import json
import subprocess
import sys

import pytest

from rrnn_opt.cli.main import COMMANDS, main

HEAVY = ("numpy", "casadi", "matplotlib", "pinocchio", "scipy")


def test_help_loads_no_numerical_library(program):
    shown = program("--help")
    assert shown.returncode == 0
    for name in COMMANDS:
        assert f"    {name} " in shown.stdout
    code = (
        "import sys, rrnn_opt.cli.main as m; m.parser().format_help();"
        f"sys.exit(any(name in sys.modules for name in {HEAVY}))"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_version(rrnn):
    shown = rrnn("--version")
    assert shown.returncode == 0
    assert shown.stdout.startswith("rrnn_opt ")


@pytest.mark.parametrize("words", [("--help",), ("--version",), ("plan", "--help")])
def test_help_is_a_document_too(words, capfd):
    assert main([*words, "--json"]) == 0
    shown = json.loads(capfd.readouterr().out)["text"]
    assert main([*words]) == 0
    assert capfd.readouterr().out == shown


@pytest.mark.parametrize(
    "words",
    [
        ("nonsense",),
        ("robots", "--jso"),
        ("verify", "--al"),
        ("check", "missing.json"),
        ("view", "missing.json"),
        ("robots", "pa11"),
        ("verify",),
        ("verify", "C999"),
        ("simulate", "minimum_velocity", "--robot", "pa10", "--task", "no.toml"),
        ("simulate", "minimum_speed", "--robot", "pa10", "--task", "no.toml"),
        ("generate", "position_feedback", "--robot", "pa10"),
        ("generate", "position_feedback", "--robot", "pa11", "--out", "x"),
    ],
)
def test_bad_input_is_one_sentence_and_one_document(words, capfd):
    assert main([*words, "--json"]) == 2
    shown, said = capfd.readouterr()
    error = json.loads(shown)["error"]
    assert error["kind"] == "bad_input"
    assert said == f"rrnn: {error['message']}\n"


def test_without_json_nothing_is_on_standard_output(capfd):
    assert main(["check", "missing.json"]) == 2
    shown, said = capfd.readouterr()
    assert shown == ""
    assert said.count("\n") == 1


def test_our_own_faults_are_named_as_such(capfd, monkeypatch):
    def broken(*_):
        raise ZeroDivisionError("nothing to divide")

    monkeypatch.setattr(COMMANDS["robots"], "run", broken)
    assert main(["robots", "--json"]) == 1
    shown, said = capfd.readouterr()
    assert "--debug" in said
    assert "nothing to divide" in json.loads(shown)["error"]["message"]
    with pytest.raises(ZeroDivisionError):
        main(["robots", "--debug"])


def test_what_a_c_library_prints_does_not_reach_the_document(capfd, monkeypatch):
    import ctypes

    def noisy(_, out):
        libc = ctypes.CDLL(None)
        libc.puts(b"a line from C")
        libc.fflush(None)
        print("a line from Python")
        out.document({"one": 1})
        out.document({"two": 2})
        return 0

    monkeypatch.setattr(COMMANDS["robots"], "run", noisy)
    assert main(["robots", "--json"]) == 0
    shown, said = capfd.readouterr()
    assert json.loads(shown) == {"one": 1}
    assert "a line from C" in said
    assert "a line from Python" in said


def test_nan_never_leaves_as_json(capfd, monkeypatch):
    def wrong(_, out):
        out.document({"x": float("nan")})
        return 0

    monkeypatch.setattr(COMMANDS["robots"], "run", wrong)
    assert main(["robots", "--json"]) == 1
    assert "NaN" not in capfd.readouterr().out


@pytest.mark.slow
@pytest.mark.parametrize("option", ["", "--json"])
def test_a_reader_that_leaves_early_stops_nothing(tmp_path, option):
    problem = {
        "robot": "planar3",
        "start": [0.0, 0.5, 0.5],
        "goal": {"joints": [1.0, 0.2, -0.4]},
    }
    (tmp_path / "p.json").write_text(json.dumps(problem))
    command = f"{sys.executable} -m rrnn_opt.cli.main plan p.json --out o {option}"
    done = subprocess.run(
        ["bash", "-c", f"set -o pipefail; {command} | true"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert "Traceback" not in done.stderr
    assert (tmp_path / "o" / "plan.html").is_file()
