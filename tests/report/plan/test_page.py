import html.parser
import importlib.util
import re
import sys

import pytest

from rrnn_opt.report.plan.page import page, write_page

EVIL = '"><script>alert(1)</script>&'
VISER = importlib.util.find_spec("viser") is not None


class Tags(html.parser.HTMLParser):
    """Collects tags and attributes outside the embedded scene."""

    def __init__(self) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict]] = []

    def handle_starttag(self, tag: str, attrs: list) -> None:
        self.tags.append((tag, dict(attrs)))


def tags(text: str) -> list[tuple[str, dict]]:
    reader = Tags()
    reader.feed(text)
    return reader.tags


@pytest.fixture
def without_viser(monkeypatch):
    monkeypatch.setitem(sys.modules, "viser", None)


@pytest.mark.slow
@pytest.mark.usefixtures("without_viser")
def test_without_viser_the_picture_and_one_sentence(window, tmp_path):
    write_page(window, tmp_path / "p.html")
    text = (tmp_path / "p.html").read_text("utf-8")
    assert "pip install rrnn_opt[viz]" in text
    assert "data:image/png;base64," in text
    assert "<iframe" not in text


@pytest.mark.slow
@pytest.mark.usefixtures("without_viser")
def test_every_string_of_a_document_is_escaped(window):
    for owner, key in (
        (window, "status"),
        (window, "message"),
        (window, "planner"),
        (window["robot"], "name"),
        (window["certificate"], "method"),
        (window["certificate"], EVIL),
        (window["versions"], "rrnn_opt"),
    ):
        owner[key] = EVIL
    window["robot"]["joint_names"] = [EVIL] * 7
    text = page(window)
    assert "alert(1)" in text
    assert not [tag for tag, _ in tags(text) if tag == "script"]


@pytest.mark.slow
@pytest.mark.usefixtures("without_viser")
def test_the_page_asks_for_nothing_from_outside(window):
    found = tags(page(window))
    policy = [a for t, a in found if t == "meta" and "content" in a]
    assert any("default-src data: blob:" in a["content"] for a in policy)
    for tag, attributes in found:
        for key in ("src", "href", "xlink:href"):
            value = attributes.get(key) or "#"
            assert value.startswith(("#", "data:")), (tag, value[:60])


@pytest.mark.skipif(not VISER, reason="the extra viz is not installed")
def test_with_viser_the_scene_is_inside_and_small(window, capfd):
    text = page(window)
    (frame,) = [a for t, a in tags(text) if t == "iframe"]
    assert "__VISER_EMBED_DATA__" in frame["srcdoc"]
    assert len(text) < 8e6
    assert not re.findall(r"<(?:script|link|img)[^>]*(?:src|href)=\"?http", text)
    assert capfd.readouterr().out == ""


@pytest.mark.slow
@pytest.mark.skipif(not VISER, reason="the extra viz is not installed")
def test_the_recording_moves_the_joints_as_long_as_the_motion_takes(window):
    import base64

    import msgspec
    import zstandard

    (frame,) = [a for t, a in tags(page(window)) if t == "iframe"]
    found = re.search(r'__VISER_EMBED_DATA__="([^"]+)"', frame["srcdoc"])
    assert found is not None
    packed = base64.b64decode(found.group(1))
    raw = zstandard.ZstdDecompressor().decompressobj().decompress(packed[8:])
    size = int.from_bytes(raw[:8], "little")
    recording = msgspec.msgpack.decode(raw[8 : 8 + size])
    assert recording["durationSeconds"] == pytest.approx(4.5, abs=1e-6)
    moves = [m for _, m in recording["messages"] if m["type"] == "SetPositionMessage"]
    assert {m["name"] for m in moves} >= {"/robot/6"}
