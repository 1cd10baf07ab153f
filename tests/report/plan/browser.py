"""A headless Chromium without a network, spoken to over a pipe (DevTools protocol)."""

from __future__ import annotations

import base64
import contextlib
import json
import os
import select
import shutil
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

NAMES = ("chromium", "chromium-browser", "google-chrome", "chrome")
FLAGS = (
    "--headless=new",
    "--no-sandbox",
    "--disable-gpu",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-background-networking",
    "--disable-component-update",
    "--no-first-run",
    "--remote-debugging-pipe",
)


def chromium() -> str | None:
    """Path of an installed Chromium."""
    return next(filter(None, map(shutil.which, NAMES)), None)


class Browser:
    """One tab: commands go out, every event that comes back is kept."""

    def __init__(self, write: int, read: int) -> None:
        self._write, self._read = write, read
        self._rest, self._last, self._session = b"", 0, ""
        self.events: list[dict[str, Any]] = []
        target = self.ask("Target.createTarget", url="about:blank")["targetId"]
        answer = self.ask("Target.attachToTarget", targetId=target, flatten=True)
        self._session = answer["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.ask(f"{domain}.enable")

    def ask(self, method: str, *, seconds: float = 60.0, **params: Any) -> Any:
        """The result of one command."""
        self._last += 1
        message = {"id": self._last, "method": method, "params": params}
        if self._session:
            message["sessionId"] = self._session
        os.write(self._write, json.dumps(message).encode() + b"\0")
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            for answer in self._messages(end - time.monotonic()):
                if answer.get("id") == self._last:
                    assert "error" not in answer, answer
                    return answer["result"]
        raise TimeoutError(f"{method}: no answer within {seconds} s")

    def evaluate(self, expression: str) -> Any:
        """The value of an expression of JavaScript in the page."""
        answer = self.ask(
            "Runtime.evaluate",
            expression=expression,
            returnByValue=True,
            awaitPromise=True,
        )
        assert "exceptionDetails" not in answer, answer
        return answer["result"].get("value")

    def wait_for(self, expression: str, seconds: float = 60.0) -> Any:
        """The first value of an expression that counts as true."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if value := self.evaluate(expression):
                return value
            time.sleep(0.2)
        raise TimeoutError(f"{expression}: not true within {seconds} s")

    def screenshot(self, box: tuple[float, float, float, float]) -> bytes:
        """A part of the window (x, y, width, height) as PNG."""
        clip = dict(zip(("x", "y", "width", "height"), box, strict=True)) | {"scale": 1}
        return base64.b64decode(self.ask("Page.captureScreenshot", clip=clip)["data"])

    def _messages(self, seconds: float) -> Iterator[dict[str, Any]]:
        ready, _, _ = select.select([self._read], [], [], max(0.0, seconds))
        if ready:
            got = os.read(self._read, 1 << 20)
            if not got:
                raise EOFError("the browser has ended")
            *whole, self._rest = (self._rest + got).split(b"\0")
            for text in whole:
                message = json.loads(text)
                if "method" in message:
                    self.events.append(message)
                yield message


@contextlib.contextmanager
def opened(folder: Path, width: int = 1280, height: int = 900) -> Iterator[Browser]:
    """A browser of a given window size, without a network where that may be."""
    command = [*_alone(), chromium() or "", *FLAGS, f"--user-data-dir={folder}"]
    command += [f"--window-size={width},{height}"]
    to_browser, from_us = os.pipe()
    to_us, from_browser = os.pipe()
    shell = f'exec "$@" 3<&{to_browser} 4>&{from_browser}'
    process = subprocess.Popen(
        ["bash", "-c", shell, "bash", *command],
        pass_fds=(to_browser, from_browser),
        stderr=subprocess.DEVNULL,
    )
    os.close(to_browser)
    os.close(from_browser)
    try:
        browser = Browser(from_us, to_us)
        browser.ask(
            "Emulation.setDeviceMetricsOverride",
            width=width,
            height=height,
            deviceScaleFactor=1,
            mobile=False,
        )
        yield browser
    finally:
        process.kill()
        process.wait()
        os.close(from_us)
        os.close(to_us)


def _alone() -> list[str]:
    """Prefix that takes the network away, where this user may."""
    unshare = shutil.which("unshare")
    if unshare is None:
        return []
    tried = subprocess.run([unshare, "-n", "true"], capture_output=True, check=False)
    return [unshare, "-n"] if tried.returncode == 0 else []
