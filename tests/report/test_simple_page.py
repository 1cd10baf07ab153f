"""Markdown as one HTML file, parsed by the standard library's reader."""

from __future__ import annotations

from html.parser import HTMLParser

import numpy as np
import pytest

from rrnn_opt.report.files import write_text
from rrnn_opt.report.simple_page import html_page

TEXT = """# A <title> & more

Words with `code <b>`, **bold** and [a link](other.html).

| name | value | words |
| --- | --- | --- |
| a | 94.0% to 100.0% | A cell of prose that is longer than a line of numbers |
| b<script> | 9e-16 | short |

- one
- two goes
  on here

![picture](missing.png)
"""


class Reader(HTMLParser):
    """Words between tags, and attributes of the cells."""

    def __init__(self) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.text = ""

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))

    def handle_data(self, data):
        self.text += data


@pytest.fixture
def page(tmp_path):
    reader = Reader()
    reader.feed(html_page(TEXT, title="<title>", folder=tmp_path))
    return reader


def test_all_words_are_there_and_none_is_code_of_the_page(page):
    for words in ("A <title> & more", "code <b>", "bold", "b<script>", "two goes on"):
        assert words in " ".join(page.text.split())
    assert "script" not in {tag for tag, _ in page.tags}


def test_numbers_stay_on_one_line_and_prose_does_not(page):
    cells = [attrs.get("class") for tag, attrs in page.tags if tag == "td"]
    assert cells == ["short", "short", None, "short", "short", "short"]


def test_links_and_lists(page):
    assert ("a", {"href": "other.html"}) in page.tags
    assert sum(tag == "li" for tag, _ in page.tags) == 2


def test_a_picture_is_put_inside_and_a_missing_one_is_named(tmp_path):
    assert "missing.png" in html_page("![p](missing.png)", title="t", folder=tmp_path)
    data = np.random.default_rng(0).bytes(64)
    (tmp_path / "there.png").write_bytes(data)
    write_text(
        tmp_path / "page.html", html_page("![p](there.png)", title="t", folder=tmp_path)
    )
    text = (tmp_path / "page.html").read_text("utf-8")
    assert 'src="data:image/png;base64,' in text
    assert "there.png" not in text
