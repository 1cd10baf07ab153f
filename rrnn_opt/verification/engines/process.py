"""A solver in a process of its own, which can be killed when its time is up.

The checker starts its solvers by lines of its own (``check/claims/methods/smt.py``),
on purpose: what looks for a proof and what judges it share nothing.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

Done = subprocess.CompletedProcess[str]


def run_apart(worker: Path, job: Mapping[str, Any], wall_s: float) -> Done | None:
    """Run a Python file on a job.

    Args:
        worker: reads the job from its standard input, as JSON.
        job: plain data.
        wall_s: the process is killed at its end, s.

    Returns:
        What the process left behind; None if it was killed.
    """
    try:
        return subprocess.run(
            [sys.executable, str(worker)],
            input=json.dumps(job),
            capture_output=True,
            text=True,
            timeout=wall_s,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return None
