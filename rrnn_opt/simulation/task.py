"""A tracking task as data: a curve for the tip, a start, control settings and noise."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.arguments import checked
from rrnn_opt.scene import Scene
from rrnn_opt.scene.fields import not_negative
from rrnn_opt.simulation.task_file import read_toml, task_fields
from rrnn_opt.simulation.task_parts import Control, Curve, Noise

Array = NDArray[np.float64]


@checked()
@dataclass(frozen=True, eq=False)
class Task:
    """A whole task file.

    Attributes:
        curve: reference of the tip.
        q0: start, (nv,), rad or m.
        frame: tracked frame; None for the robot's tip.
        control: settings of the loop.
        noise: settings of the noise.
        scene: obstacles; without any, no contact is ever active.
        contacts: index of the robot's sphere in each contact that a scheme
            with contacts is told of; None: with obstacles one sphere a link, as
            many of them, from the tip, as the scheme admits.
    """

    curve: Curve
    q0: Array
    frame: str | None = None
    control: Control = field(default_factory=Control)
    noise: Noise = field(default_factory=Noise)
    scene: Scene = field(default_factory=Scene)
    contacts: tuple[int, ...] | None = None

    @property
    def steps(self) -> int:
        """Number of control steps."""
        return round(self.curve.duration / self.control.dt)

    def with_noise(self, sigma: float, *, seed: int | None = None) -> Task:
        """The same task with another noise.

        Args:
            sigma: standard deviation, in the unit of what is disturbed.
            seed: of the noise; the task's own by default.

        Raises:
            ProblemError: sigma is no number, or negative.
        """
        noise = Noise(
            self.noise.enters,
            not_negative(sigma, "noise.sigma"),
            self.noise.seed if seed is None else seed,
        )
        return replace(self, noise=noise)

    @staticmethod
    def load(path: str | Path) -> Task:
        """Read a TASK.toml.

        Args:
            path: task file (TOML).

        Raises:
            DocumentError: the file cannot be read or is no TOML.
            ProblemError: a field is missing, unknown or wrong; it is named.
        """
        return Task.from_dict(read_toml(path))

    @staticmethod
    def from_dict(data: Mapping[str, Any]) -> Task:
        """The task of a parsed document.

        Args:
            data: as from a TASK.toml.

        Raises:
            ProblemError: a field is missing, unknown or wrong; it is named.
        """
        return Task(**task_fields(data))
