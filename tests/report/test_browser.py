"""The page of a plan in a real browser that has no network."""

import importlib.util
from pathlib import Path

import pytest

from rrnn_opt.report.page import write_page

_SPEC = importlib.util.spec_from_file_location(
    "report_browser", Path(__file__).with_name("browser.py")
)
browser = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(browser)

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


@pytest.mark.slow
def test_the_page_plays_the_motion_offline_and_without_an_error(tab):
    begin = instant(tab)
    tab.wait_for(f"{PLAYER}.getAttribute('aria-valuenow') != {begin}")
    assert [url for url in asked(tab.events) if not url.startswith(LOCAL)] == []
    assert list(complaints(tab.events)) == []
