"""Commands that the pages name exist: their words, options, modules and targets."""

import importlib.util
import re
import shlex
from pathlib import Path

import pytest

from rrnn_opt.cli.main import COMMANDS, parsed
from rrnn_opt.cli.output import UsageError

ROOT = Path(__file__).parents[1]
PAGES = sorted(
    page
    for page in [ROOT / "README.md", *(ROOT / "docs").rglob("*.md")]
    if "_build" not in page.parts
)
FENCED = re.compile(r"^```(?:sh)?\n(.*?)^```", re.M | re.S)
INLINE = re.compile(r"`([^`\n]+)`")


def commands(text):
    """Words of each command in a page's blocks and between its backticks."""
    lines = [line for block in FENCED.findall(text) for line in block.splitlines()]
    prose = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    for line in [*lines, *INLINE.findall(prose)]:
        line = re.sub(r"^([A-Z_]+=\S+ +)+", "", line)
        if re.match(r"(rrnn|python -m|make) \S", line):
            yield shlex.split(line, comments=True)


def fault(words):
    """What is wrong with a command, or nothing."""
    if words[0] == "make":
        targets = re.findall(r"^(\w+):", (ROOT / "Makefile").read_text(), re.M)
        return "" if words[1] in targets else f"no target {words[1]}"
    if words[0] == "python":
        found = words[2] == "pytest" or importlib.util.find_spec(words[2])
        return "" if found else f"no module {words[2]}"
    if "..." in words or (words[1] in COMMANDS and len(words) == 2):
        return ""
    try:
        parsed(words[1:])
    except UsageError as error:
        return str(error)
    except SystemExit as end:  # --help
        return f"status {end.code}" if end.code else ""
    return ""


@pytest.mark.parametrize("page", PAGES, ids=lambda p: str(p.relative_to(ROOT)))
def test_every_command_of_a_page_exists(page, capsys):
    found = list(commands(page.read_text("utf-8")))
    assert [(words, fault(words)) for words in found if fault(words)] == []


def test_a_command_that_does_not_exist_is_found():
    text = "```sh\nrrnn plan --sed 1 p.json  # 1\nmake it\n```\n`python -m lost`\n"
    assert [bool(fault(words)) for words in commands(text)] == [True] * 3
