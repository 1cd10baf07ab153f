"""The page of a plan in a real browser that has no network."""

import importlib.util
import time
from pathlib import Path

import pytest

from rrnn_opt.report.plan.page import write_page

_SPEC = importlib.util.spec_from_file_location(
    "report_browser", Path(__file__).with_name("browser.py")
)
browser = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(browser)

BOX = ("x", "y", "width", "height")
LOCAL = ("file:", "data:", "blob:", "about:")
SCENE = "document.querySelector('iframe')?.contentDocument"
PLAYER = f"{SCENE}?.querySelector('[role=slider]')"


@pytest.fixture
def tab(window, tmp_path):
    """The page of a plan, opened."""
    pytest.importorskip("viser")
    if browser.chromium() is None:
        pytest.skip("needs a browser: Debian's package chromium")
    write_page(window, tmp_path / "plan.html")
    with browser.opened(tmp_path / "profile") as opened:
        opened.ask("Page.navigate", url=(tmp_path / "plan.html").as_uri())
        opened.wait_for(f"!!{PLAYER}", seconds=150.0)
        yield opened


def asked(events):
    """Addresses that the page asked for."""
    return [
        event["params"]["request"]["url"]
        for event in events
        if event["method"] == "Network.requestWillBeSent"
    ]


def complaints(events):
    """Errors on the console, and exceptions that nothing caught."""
    for event in events:
        given = event["params"]
        kind = given.get("type") or given.get("entry", {}).get("level")
        if event["method"] == "Runtime.exceptionThrown" or kind == "error":
            yield given


def instant(tab):
    """Where the time slider stands, s."""
    return float(tab.evaluate(f"{PLAYER}.getAttribute('aria-valuenow')"))


def moving(tab, *, seconds):
    """Does the scene change by itself, what is under and over it left out?"""
    frame = "document.querySelector('iframe').getBoundingClientRect()"
    x, y, width, height = (tab.evaluate(f"{frame}.{k}") for k in BOX)
    middle = (x + width / 4, y + height / 4, width / 2, height / 2)
    end, seen = time.monotonic() + seconds, set()
    while len(seen) < 4 and time.monotonic() < end:
        seen.add(tab.screenshot(middle))
        time.sleep(0.5)
    return len(seen) >= 4


@pytest.mark.slow
def test_the_page_plays_the_motion_offline_and_without_an_error(tab):
    begin = instant(tab)
    tab.wait_for(f"{PLAYER}.getAttribute('aria-valuenow') != {begin}")
    assert moving(tab, seconds=120.0)
    assert [url for url in asked(tab.events) if not url.startswith(LOCAL)] == []
    assert list(complaints(tab.events)) == []
