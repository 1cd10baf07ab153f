"""The robot as frozen arrays; how one is come by, the arrays do not know."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from rrnn_opt.arguments import checked
from rrnn_opt.errors import RobotError
from rrnn_opt.robot.tree import Frame, JointTree, Limits, Sphere


@dataclass(frozen=True, eq=False)
class RobotData:
    """A robot arm as frozen arrays; coordinates are plain joint angles (or metres).

    Attributes:
        name: e.g. "pa10".
        joint_names: one a coordinate, nv of them.
        tree: the joints.
        limits: of the coordinates.
        frames: named frames; the end effector is among them.
        tip: name of the end-effector frame.
        spheres: collision spheres.
        self_pairs: pairs of links that are checked against each other.
        cover: what the spheres stand for: {"inflation_m": (least, most)} of
            covers, {"missing": [...]} links with geometry but no spheres.
        source: where the numbers come from.
        licence: licence of the description.
    """

    name: str
    joint_names: tuple[str, ...]
    tree: JointTree
    limits: Limits
    frames: tuple[Frame, ...]
    tip: str
    spheres: tuple[Sphere, ...] = ()
    self_pairs: tuple[tuple[str, str], ...] = ()
    cover: dict[str, Any] = field(default_factory=dict)
    source: str = ""
    licence: str = ""

    @property
    def nv(self) -> int:
        """Number of coordinates."""
        return len(self.joint_names)

    @checked()
    def frame(self, name: str | None = None) -> Frame:
        """The frame of that name; the tip when no name is given.

        Args:
            name: of a frame; None for the tip.

        Raises:
            RobotError: there is no such frame.
        """
        wanted = self.tip if name is None else name
        for candidate in self.frames:
            if candidate.name == wanted:
                return candidate
        known = ", ".join(f.name for f in self.frames[-12:])
        raise RobotError(self.name, f"no frame '{wanted}'; it has {known}")

    def sphere_pairs(self) -> list[tuple[int, int]]:
        """Index pairs of spheres, one for every two spheres of a self pair."""
        of: dict[str, list[int]] = {
            link: [] for pair in self.self_pairs for link in pair
        }
        for index, sphere in enumerate(self.spheres):
            of.setdefault(sphere.link, []).append(index)
        return [(i, j) for a, b in self.self_pairs for i in of[a] for j in of[b]]
