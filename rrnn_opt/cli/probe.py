"""Try QP solvers for real, in a process of their own.

``python -m rrnn_opt.cli.probe NAME...`` prints one JSON line a solver: a back
end that crashes or hangs takes only this process with it.
"""

from __future__ import annotations

import json
import subprocess
import sys
import time
from typing import Any

PATIENCE_S = 60.0


def probe(names: list[str], *, patience: float = PATIENCE_S) -> list[dict[str, Any]]:
    """Try solvers one after the other.

    Args:
        names: back ends of qpsolvers.
        patience: s, for all of them together.

    Returns:
        One record a solver: name, solves, notices_infeasible, message.
    """
    records: list[dict[str, Any]] = []
    deadline = time.monotonic() + patience
    while len(records) < len(names):
        rest = names[len(records) :]
        lines, reason = _child(rest, max(0.1, deadline - time.monotonic()))
        records += lines
        if len(lines) < len(rest):
            records.append(_record(rest[len(lines)], False, False, reason))
    return records


def _child(names: list[str], patience: float) -> tuple[list[dict[str, Any]], str]:
    """What a child process managed to say, and why it stopped."""
    command = [sys.executable, "-m", "rrnn_opt.cli.probe", *names]
    try:
        done = subprocess.run(
            command, capture_output=True, timeout=patience, check=False
        )
        output, reason = done.stdout, f"the process ended with status {done.returncode}"
    except subprocess.TimeoutExpired as error:
        output, reason = error.stdout or b"", "no answer in time"
    lines = []
    for line in output.decode(errors="replace").splitlines():
        if line.startswith("{"):
            lines.append(json.loads(line))
    return lines, reason


def try_solver(name: str) -> dict[str, Any]:
    """Solve ``min |x - (1, 2)|^2, x1 + x2 <= 1`` and look at an empty set.

    The solution of the first is (0, 1); the second asks for x <= -1 and x >= 1.
    """
    import numpy as np
    from qpsolvers import Problem, solve_problem

    eye, q, row = 2 * np.eye(2), np.array([-2.0, -4.0]), np.ones((1, 2))
    good = Problem(eye, q, G=row, h=np.array([1.0]))
    sides = np.concatenate([np.eye(2), -np.eye(2)])
    empty = Problem(eye, q, G=sides, h=-np.ones(4))
    try:
        answer = solve_problem(good, solver=name)
        solves = answer.x is not None and np.abs(answer.x - [0.0, 1.0]).max() < 1e-3
    except Exception as error:
        return _record(name, False, False, f"{type(error).__name__}: {error}")
    if not solves:
        return _record(name, False, False, "its answer is wrong")
    try:
        claims = bool(solve_problem(empty, solver=name).found)
    except Exception:
        claims = False
    message = "finds a solution of an infeasible problem" if claims else ""
    return _record(name, True, not claims, message)


def _record(name: str, solves: bool, notices: bool, message: str) -> dict[str, Any]:
    return {
        "name": name,
        "solves": solves,
        "notices_infeasible": notices,
        "message": " ".join(message.split())[:200],
    }


def _main() -> None:
    import os
    import warnings

    warnings.simplefilter("ignore")
    real = os.dup(1)
    os.dup2(2, 1)  # what a solver prints is not an answer
    for name in sys.argv[1:]:
        os.write(real, (json.dumps(try_solver(name)) + "\n").encode())


if __name__ == "__main__":
    _main()
