"""The head of a page of results: how, where and when."""

from __future__ import annotations

import datetime
import os
import platform
from collections.abc import Sequence
from importlib import metadata

from rrnn_opt.study import processor

PACKAGES = ("rrnn_opt", "casadi", "numpy")


def head(title: str, command: str) -> str:
    """Title, command, machine, versions and date, in Markdown.

    Args:
        title: of the page.
        command: that makes it.
    """
    versions = ", ".join(f"{name} {metadata.version(name)}" for name in PACKAGES)
    today = datetime.datetime.now(datetime.UTC).date().isoformat()
    lines = [
        f"# {title}",
        "",
        f"Command: `{command}`  ",
        f"Machine: {processor()}, {os.cpu_count()} cores, "
        f"Python {platform.python_version()}  ",
        f"Versions: {versions}  ",
        f"Date: {today}",
    ]
    return "\n".join(lines)


def spelled(program: str, words: Sequence[str]) -> str:
    """A command line as one would type it."""
    return " ".join([program, *words])
