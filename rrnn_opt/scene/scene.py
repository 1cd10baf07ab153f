"""The scene: all obstacles of a problem."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, get_args

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.arguments import checked
from rrnn_opt.errors import ProblemError
from rrnn_opt.scene import fields
from rrnn_opt.scene.mesh import Mesh
from rrnn_opt.scene.points import Points
from rrnn_opt.scene.shapes import PACKED, Obstacle

KINDS: tuple[str, ...] = tuple(shape.kind for shape in get_args(Obstacle))
"""Kinds of shapes in the fixed order that packed scenes and emitted code use."""

Member = Obstacle | Mesh | Points
"""What may stand in a scene: a shape, the hull of a mesh, or a cloud of points."""


@checked(skip=["obstacles"])
@dataclass(frozen=True, eq=False)
class Scene:
    """Obstacles in the order in which they were given.

    Attributes:
        obstacles: any number of shapes.

    Raises:
        ProblemError: these are no entries, or an entry is not a shape.
    """

    obstacles: tuple[Member, ...] = ()

    def __post_init__(self) -> None:
        try:
            given = tuple(self.obstacles)
        except TypeError:
            message = f"expected shapes, got {fields.shown(self.obstacles)}"
            raise ProblemError("obstacles", message) from None
        object.__setattr__(self, "obstacles", given)
        for index, obstacle in enumerate(self.obstacles):
            if not isinstance(obstacle, Member):
                message = f"expected a shape, got {fields.shown(obstacle)}"
                raise ProblemError(f"obstacles[{index}]", message)

    def __len__(self) -> int:
        return len(self.obstacles)

    def __iter__(self) -> Iterator[Member]:
        return iter(self.obstacles)

    def of_kind(self, kind: str) -> tuple[Member, ...]:
        """The obstacles of one kind, in their order."""
        return tuple(o for o in self.obstacles if o.kind == kind)

    def pack(self) -> dict[str, NDArray[np.float64]]:
        """Packed shapes by kind, every kind of ``KINDS`` in that order.

        Returns:
            Arrays (count, 16), contiguous, one row a shape; row k of a kind is
            ``of_kind(kind)[k]``.
        """
        return {
            kind: np.array([o.pack() for o in self.of_kind(kind)]).reshape(-1, PACKED)
            for kind in KINDS
        }

    def to_dict(self) -> list[dict[str, Any]]:
        """The obstacles as the problem file writes them."""
        return [obstacle.to_dict() for obstacle in self.obstacles]
