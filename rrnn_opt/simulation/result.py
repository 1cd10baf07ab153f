"""What a closed-loop run recorded, and its figures."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from rrnn_opt.robot import Kinematics, Robot
from rrnn_opt.simulation.obstacles import least_clearance
from rrnn_opt.simulation.record import Record
from rrnn_opt.simulation.task import Array, Task

ROUNDING = 1e-9
"""A limit exceeded by less than this (rad, m, or per second) counts as kept."""


@dataclass(frozen=True, eq=False)
class SimulationResult:
    """A tracked curve; row k is at t[k], its velocities hold until t[k+1].

    Attributes:
        scheme: name of the network that tracked it.
        robot: the robot.
        task: as run.
        t: (rows,), s.
        reference: where the tip should be, (rows, 3), m.
        record: what the loop wrote.
        step: Euler step of the network, s.
        level: what the scheme commands: velocity, acceleration or increment.
    """

    scheme: str
    robot: Robot
    task: Task
    t: Array
    reference: Array
    record: Record
    step: float
    level: str = "velocity"

    @property
    def q(self) -> Array:
        """Positions, (rows, nv), rad or m."""
        return self.record.q

    @property
    def qd(self) -> Array:
        """Velocities done, noise included, (rows, nv), rad/s or m/s."""
        return self.record.qd

    @property
    def command(self) -> Array:
        """Velocity (rad/s), acceleration (rad/s2) or increment (rad), (rows, nv).

        Of a prismatic joint m/s, m/s2 or m.
        """
        return self.record.command

    @property
    def tip(self) -> Array:
        """Positions of the tracked frame, (rows, 3), m."""
        return self.record.tip

    @cached_property
    def error(self) -> Array:
        """Reference minus tip, (rows, 3), m."""
        return self.reference - self.tip

    @property
    def rms_error_m(self) -> float:
        """Root mean square over the rows of the error's length, m."""
        return float(np.sqrt(np.mean(np.sum(self.error**2, axis=1))))

    @property
    def max_error_m(self) -> float:
        """Largest length of the error at a row, m."""
        return float(np.linalg.norm(self.error, axis=1).max())

    @property
    def limits_kept(self) -> bool:
        """Positions, velocities and commands within the robot's limits.

        Noise on the velocity acts behind the command: the velocity judged is
        that without it.  Accelerations are judged where they are commanded.
        """
        limits = self.robot.limits
        low = (self.q >= limits.lower - ROUNDING).all()
        high = (self.q <= limits.upper + ROUNDING).all()
        speed = self.record.velocity
        slow = (np.abs(speed) <= limits.velocity + ROUNDING).all()
        kept = bool(low and high and slow)
        if self.level == "acceleration":
            excess = np.abs(self.command) - limits.acceleration
            return kept and bool((excess <= ROUNDING).all())
        return kept

    @cached_property
    def least_clearance_m(self) -> float | None:
        """Least clearance of a moving sphere at a row, m; None without obstacles."""
        if not len(self.task.scene):
            return None
        return least_clearance(Kinematics(self.robot), self.task.scene, self.q)

    @property
    def steps(self) -> int:
        """Control steps."""
        return len(self.t) - 1

    def to_dict(self, files: Sequence[str | Path] = ()) -> dict[str, Any]:
        """The document of ``rrnn simulate --json``.

        Args:
            files: names of files written beside it.
        """
        return {
            "rms_error_m": self.rms_error_m,
            "max_error_m": self.max_error_m,
            "duration_s": float(self.t[-1]),
            "steps": self.steps,
            "limits_kept": self.limits_kept,
            "seed": self.task.noise.seed,
            "files": [str(name) for name in files],
            "scheme": self.scheme,
            "robot": self.robot.name,
            "network_steps": self.record.network_steps,
            "unsettled": self.record.unsettled,
            "least_clearance_m": self.least_clearance_m,
        }

    def to_csv(self) -> str:
        """Table of t, q, qd, tip and reference, one row a control step."""
        nv = self.robot.nv
        head = ["t", *_names("q", nv), *_names("qd", nv), "x", "y", "z"]
        columns = (self.t[:, None], self.q, self.qd, self.tip, self.reference)
        text = io.StringIO()
        writer = csv.writer(text)
        writer.writerow([*head, "xd", "yd", "zd"])
        writer.writerows(np.hstack(columns).tolist())
        return text.getvalue()

    def write_csv(self, path: str | Path) -> None:
        """Write what :meth:`to_csv` gives.

        Args:
            path: the file; it is replaced.
        """
        Path(path).write_text(self.to_csv(), "utf-8", newline="")


def _names(stem: str, count: int) -> list[str]:
    return [f"{stem}{k + 1}" for k in range(count)]
