"""Links of the pages lead somewhere, and commands of the page of troubles run."""

import re
import shlex
import shutil
from pathlib import Path
from urllib.parse import unquote

import pytest

from rrnn_opt.cli.main import main

ROOT = Path(__file__).parents[1]
PAGES = sorted(
    p
    for p in [ROOT / "README.md", ROOT / "CHANGELOG.md", *(ROOT / "docs").rglob("*.md")]
    if "_build" not in p.parts
)
LINK = re.compile(r"!?\[[^\]]*\]\(([^()\s]+(?:\([^()]*\)[^()\s]*)?)\)")


def prose(text):
    """A page without its code, where brackets mean something else."""
    text = re.sub(r"^(```|~~~).*?^\1\s*$", "", text, flags=re.M | re.S)
    return re.sub(r"`[^`\n]*`", "code", text)


def anchors(text):
    """Slugs of a page's headings, as GitHub and MyST make them."""
    body = re.sub(r"^(```|~~~).*?^\1\s*$", "", text, flags=re.M | re.S)
    heads = re.findall(r"^#{1,3} +(.+?)\s*$", body, re.M)
    slugs = [re.sub(r"[^\w\- ]", "", h.lower()).replace(" ", "-") for h in heads]
    return {*slugs, *re.findall(r'(?:id|name)="([^"]+)"', text)}


def lost_links(page, text):
    """Relative links of a page that lead nowhere."""
    for link in LINK.findall(prose(text)):
        if re.match(r"[a-z]+:", link):
            continue
        path, _, anchor = unquote(link).partition("#")
        target = (page.parent / path).resolve() if path else page
        if not target.exists():
            yield link
        elif anchor and target.suffix == ".md":
            there = text if target == page else target.read_text("utf-8")
            if anchor not in anchors(there):
                yield link


@pytest.mark.parametrize("page", PAGES, ids=lambda p: str(p.relative_to(ROOT)))
def test_every_relative_link_leads_somewhere(page):
    assert list(lost_links(page, page.read_text("utf-8"))) == []


def test_a_lost_link_is_found():
    page = ROOT / "docs" / "index.md"
    text = "# A b\n[x](lost.md) [y](notation.md#terms) [z](#a-b) [w](#nothing)\n"
    assert list(lost_links(page, text)) == ["lost.md", "#nothing"]


def test_every_page_of_the_site_is_in_a_table_of_contents():
    index = (ROOT / "docs" / "index.md").read_text("utf-8")
    for page in (ROOT / "docs").glob("*.md"):
        assert page.stem == "index" or re.search(rf"^{page.stem}$", index, re.M), page


def commands(page):
    """Commands of a page's blocks with the exit status that each names."""
    for block in re.findall(r"^```sh\n(.*?)^```", page.read_text("utf-8"), re.M | re.S):
        for line in block.splitlines():
            words, _, remark = line.partition("#")
            status = int(remark) if remark.strip().isdigit() else 0
            yield shlex.split(words), status


@pytest.mark.slow
def test_commands_of_the_page_of_troubles(tmp_path, monkeypatch, capfd):
    """In order, in one folder: later ones go on with what earlier ones wrote."""
    monkeypatch.chdir(tmp_path)
    shutil.copy(ROOT / "examples" / "window.json", tmp_path)
    found = list(commands(ROOT / "docs" / "troubleshooting.md"))
    assert len(found) >= 8
    for words, status in found:
        with monkeypatch.context() as scope:
            while "=" in words[0]:
                name, _, value = words.pop(0).partition("=")
                scope.setenv(name, str(tmp_path / value))
            assert words[0] == "rrnn"
            assert main(words[1:]) == status, (words, capfd.readouterr().err)


@pytest.mark.slow
def test_commands_of_the_page_on_own_robots_do_what_they_say(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    shutil.copy(ROOT / "examples" / "planar_arm.urdf", tmp_path)
    shutil.copy(ROOT / "examples" / "planar_arm.urdf", tmp_path / "arm.urdf")
    found = list(commands(ROOT / "docs" / "tutorials" / "own_robot.md"))
    assert [words[1] for words, _ in found] == [
        "robots",
        "spheres",
        "verify",
        "generate",
    ]
    assert [main(words[1:]) for words, _ in found] == [status for _, status in found]
