import json

import pytest

from rrnn_opt.cli.main import main


@pytest.mark.slow
def test_a_part_of_the_paper_from_the_command_line(tmp_path, capfd):
    words = ["reproduce", "fig4", "raven", "--trials", "3", "--out", str(tmp_path)]
    assert main([*words, "--json"]) == 0
    data = json.loads(capfd.readouterr().out)
    for cell in data["cells"]:
        assert set(cell) >= {
            *("table", "row", "column", "paper", "ours", "interval", "n"),
            *("verdict", "reason", "command", "rows"),
        }
    names = {path.name for path in tmp_path.iterdir()}
    assert names >= {"reproduce.md", "reproduce.html", "fig4.png", "raven.png"}
    assert main([*words, "--resume", "--json"]) == 0
    assert json.loads(capfd.readouterr().out)["cells"] == data["cells"]


def test_an_unknown_part_is_said(capfd):
    assert main(["reproduce", "table5"]) == 2
    assert "no part is called 'table5'" in capfd.readouterr().err
