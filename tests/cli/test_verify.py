"""``rrnn verify``: tables, reports and exit states."""

from __future__ import annotations

import json

import pytest

from rrnn_opt.cli.main import main

OWN = """
import casadi as ca
import rrnn_opt as rr
from rrnn_opt.claim import Relation
from rrnn_opt.symbolic import Symbol

def claims():
    x = Symbol.scalar("x")
    return [rr.Claim("mine", "here", "words", (x,), Relation(x.sx**2{tail}, ">=0"))]
"""


@pytest.fixture(autouse=True)
def _folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def document(capfd):
    return json.loads(capfd.readouterr().out)


def test_a_report_stands_beside_the_certificates(capfd, tmp_path):
    words = ["verify", "C19", "C34", "C5", "--robot", "planar3", "--json"]
    assert main([*words, "--out", "v"]) == 0
    shown = document(capfd)
    rows = {row["id"]: row for row in shown["claims"]}
    assert set(rows) == {"C5", "C19", "C34"}
    assert rows["C5"]["kind"] == "NO_PROPOSITION"
    assert rows["C34"]["repaired"]["verdict"] == "HOLDS_UNDER"
    for row in (rows["C34"], rows["C19"]):
        for path in (row["certificate"], row["repaired"]["certificate"]):
            assert main(["check", path]) == 0
    assert json.loads((tmp_path / "v/claims.json").read_text()) == shown
    page = (tmp_path / "v/claims.html").read_text()
    assert page.startswith("<!doctype html>")
    assert "1/(1 + n p)" in page
    assert "Theorem 3.1" in (tmp_path / "v/claims.md").read_text()


def test_ids_with_a_prime_are_understood(capfd):
    assert main(["verify", "C23'", "--json", "--robot", "planar3"]) == 0
    assert document(capfd)["claims"][0]["id"] == "C23p"


def test_a_surprise_is_an_exit_state(capfd, monkeypatch):
    table = "rrnn_opt.validation.claims.expected.surprises"
    monkeypatch.setattr(table, lambda rows: {"C39": "REFUTED"})
    assert main(["verify", "C39", "--robot", "planar3"]) == 1
    assert "FAIL  C39: expected REFUTED" in capfd.readouterr().out


def test_own_claims_are_refuted_or_not(capfd, tmp_path):
    (tmp_path / "good.py").write_text(OWN.replace("{tail}", ""))
    (tmp_path / "bad.py").write_text(OWN.replace("{tail}", " - 1"))
    (tmp_path / "none.py").write_text("x = 1\n")
    assert main(["verify", "good.py"]) == 0
    assert main(["verify", "bad.py"]) == 1
    capfd.readouterr()
    assert main(["verify", "none.py", "--json"]) == 2
    assert "claims()" in document(capfd)["error"]["message"]
    assert main(["verify", "--json"]) == 2


@pytest.mark.slow
def test_a_scheme_on_a_robot(capfd):
    words = ["verify", "--formulation", "closed_loop", "--robot", "panda", "--json"]
    assert main(words) == 0
    rows = {row["id"]: row["verdict"] for row in document(capfd)["claims"]}
    assert rows["equilibrium_is_optimum"] == "PROVED"
    assert set(rows.values()) <= {"PROVED", "HOLDS_UNDER"}
    assert len(rows) >= 7


def test_the_page_of_ones_own_claims_speaks_of_them_alone(capfd, tmp_path):
    (tmp_path / "own.py").write_text(OWN.format(tail=""))
    assert main(["verify", "own.py", "--out", "v"]) == 0
    text = (tmp_path / "v/claims.md").read_text()
    assert "`rrnn verify own.py --out DIR`" in text
    assert "validation/claims" not in text
    assert "Mutations" not in text
    assert "variant" not in (tmp_path / "v/claims.html").read_text()
    capfd.readouterr()
    assert main(["view", "v", "--json"]) == 0
    assert document(capfd) == {"page": "v/claims.html"}
    assert main(["view", "v/claims.json"]) == 0
    assert main(["check", "v/claims.json"]) == 2
    assert "check one of the certificates" in capfd.readouterr().err


def test_a_folder_without_a_result_has_no_page(capfd, tmp_path):
    assert main(["view", "."]) == 2
    assert "neither plan.json nor a report" in capfd.readouterr().err
