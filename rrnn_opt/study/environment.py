"""Where and when a result was made."""

from __future__ import annotations

import os
import platform
import subprocess
from collections.abc import Iterable, Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from rrnn_opt.study.identity import PACKAGES, code_fingerprint, versions
from rrnn_opt.study.threads import VARIABLES


def environment(
    settings: Mapping[str, Any] | None = None, *, packages: Iterable[str] = PACKAGES
) -> dict[str, Any]:
    """Machine, load, versions, commit and settings, ready for JSON.

    Args:
        settings: of the run.
        packages: whose versions are named.
    """
    return {
        "date": datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ"),
        "processor": processor(),
        "cores": os.cpu_count(),
        "load": [round(x, 2) for x in os.getloadavg()],
        "system": f"{platform.system()} {platform.machine()}",
        "python": platform.python_version(),
        "versions": versions(("rrnn_opt", *packages)),
        "commit": commit(),
        "code": code_fingerprint(),
        "threads": {name: os.environ.get(name) for name in VARIABLES[:2]},
        "settings": dict(settings or {}),
    }


def processor() -> str:
    """The processor's name where the system tells it."""
    source = Path("/proc/cpuinfo")
    lines = source.read_text("utf-8").splitlines() if source.exists() else []
    names = [line.split(":", 1)[1].strip() for line in lines if "model name" in line]
    return names[0] if names else platform.machine()


def commit() -> str | None:
    """Commit of the checkout that the package runs from, "+" where it is changed."""
    import rrnn_opt

    root = Path(rrnn_opt.__file__).resolve().parent.parent
    if not (root / ".git").exists():
        return None
    try:
        name = _git(root, "rev-parse", "--short=12", "HEAD")
        changed = _git(root, "status", "--porcelain", "--untracked-files=no")
    except (OSError, subprocess.SubprocessError):
        return None
    return name + ("+" if changed else "")


def _git(root: Path, *words: str) -> str:
    command = ["git", "-C", str(root), *words]
    done = subprocess.run(
        command, capture_output=True, text=True, check=True, timeout=10
    )
    return done.stdout.strip()
