"""The commands of two tutorials run as they stand, in order, in one folder."""

import re
import shlex
import shutil
from pathlib import Path

import pytest

from rrnn_opt.cli.main import main

ROOT = Path(__file__).parents[1]
WHOLE = ("--all", "runs/claims")
"""Words of commands that take all claims of the paper; tests/validation runs them."""


def commands(page):
    """Words of the commands in a page's blocks of shell."""
    text = (ROOT / "docs" / "tutorials" / page).read_text("utf-8")
    for block in re.findall(r"^```sh\n(.*?)^```", text, re.M | re.S):
        for line in block.splitlines():
            if not any(word in line for word in WHOLE):
                yield shlex.split(line, comments=True)


@pytest.mark.slow
@pytest.mark.parametrize(("page", "number"), [("plan.md", 4), ("verify.md", 5)])
def test_commands_of_a_tutorial(page, number, tmp_path, monkeypatch, capfd):
    """One exit status is 1: what its claims are there to show does not hold."""
    monkeypatch.chdir(tmp_path)
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    found = list(commands(page))
    assert len(found) == number
    for words in found:
        assert words[0] == "rrnn"
        bad = "verify_my_network.py" in " ".join(words) and words[1] == "verify"
        assert main(words[1:]) == int(bad), (words, capfd.readouterr().err)
