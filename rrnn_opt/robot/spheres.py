"""Fit covering spheres to a URDF's geometry, and prove that they cover it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np

from rrnn_opt.robot.cover import cover_box, cover_cylinder
from rrnn_opt.robot.cover_proof import uncovered
from rrnn_opt.robot.geometry import Geometry, collision_geometry, ever_touch
from rrnn_opt.robot.kinematics import Kinematics
from rrnn_opt.robot.robot import Robot
from rrnn_opt.robot.solid_cover import cover_solid
from rrnn_opt.robot.sphere_file import checked_pairs, placed_spheres
from rrnn_opt.robot.tree import Array
from rrnn_opt.robot.urdf import Urdf, read_urdf

POSTURES = 400
"""Random postures in which pairs are looked at."""
NEIGHBOURS = 2
SEED = 0


@dataclass(frozen=True)
class LinkCover:
    """How a link was covered.

    Attributes:
        link: its name.
        balls: (center (3,), radius), m, in the link's frame.
        inflation: how far they bulge out of the geometry, m.
        uncovered: triangles of its meshes that are not shown to be covered.
        triangles: of its meshes.
    """

    link: str
    balls: tuple[tuple[Array, float], ...]
    inflation: float
    uncovered: int
    triangles: int


@dataclass(frozen=True)
class FittedSpheres:
    """Spheres of a whole URDF.

    Attributes:
        links: covers, in the file's order.
        disabled: (link, link, reason) pairs that should not be checked.
        visual: links whose visual geometry was taken for want of another.
    """

    links: tuple[LinkCover, ...]
    disabled: tuple[tuple[str, str, str], ...]
    visual: tuple[str, ...]

    @property
    def covered(self) -> bool:
        """Every triangle of every mesh is shown to lie in the spheres."""
        return all(link.uncovered == 0 for link in self.links)

    def to_dict(self) -> dict[str, Any]:
        """The sphere file."""
        return {
            "links": {
                cover.link: [
                    {"center": center.tolist(), "radius": radius}
                    for center, radius in cover.balls
                ]
                for cover in self.links
            },
            "disabled_self_collision_pairs": [list(row) for row in self.disabled],
        }


def fit_spheres(
    path: str | Path,
    *,
    tip: str | None = None,
    tips: Sequence[str] = (),
    inflation: float = 0.02,
    most: int = 16,
    folders: tuple[Path, ...] = (),
) -> FittedSpheres:
    """Covering spheres of every link of a URDF.

    Args:
        path: the URDF.
        tip: end-effector link, for the joints that move when pairs are looked
            at; by default that of ``Robot.from_urdf``.
        tips: links of several arms that move at once, in place of ``tip``.
        inflation: wanted bulge, m; missed where ``most`` is too small.
        most: spheres a piece of geometry, at most.
        folders: where ``package://`` paths may start.

    Returns:
        Covers and disabled pairs: links that a joint connects, links whose
        spheres overlap in all of ``POSTURES`` random postures, of which
        checking would forbid every posture, and links at most ``NEIGHBOURS``
        joints apart whose spheres overlap in some of these postures while
        their geometry touches in none.  The last is sampled, not proved; the
        file says so in the pair's reason.

    Raises:
        RobotError: the file or a mesh cannot be read.
    """
    urdf = read_urdf(path)
    geometry, visual = collision_geometry(urdf, folders)
    covers = tuple(
        _link_cover(link, pieces, inflation, most) for link, pieces in geometry.items()
    )
    robot = Robot.from_urdf(path, tip=tip, tips=tips)
    balls = {cover.link: cover.balls for cover in covers}
    disabled = _disabled(robot, urdf, balls, geometry)
    return FittedSpheres(covers, disabled, tuple(visual))


def _link_cover(
    link: str, pieces: list[Geometry], inflation: float, most: int
) -> LinkCover:
    balls: list[tuple[Array, float]] = []
    bulges, left, triangles = [0.0], 0, 0
    for piece in pieces:
        centers, radii, bulge = _fitted(piece, inflation, most)
        bulges.append(bulge)
        triangles += len(piece.triangles)
        left += len(uncovered(piece.vertices, piece.triangles, centers, radii))
        rotation, origin = piece.pose[:3, :3], piece.pose[:3, 3]
        placed = centers @ rotation.T + origin
        balls += [(c, float(r)) for c, r in zip(placed, radii, strict=True)]
    return LinkCover(link, tuple(balls), max(bulges), left, triangles)


def _fitted(piece: Geometry, inflation: float, most: int) -> tuple[Array, Array, float]:
    if piece.kind == "mesh":
        fit = cover_solid(
            piece.vertices, piece.triangles, inflation=inflation, most=most
        )
        return fit.centers, fit.radii, fit.inflation
    if piece.kind == "sphere":
        return np.zeros((1, 3)), np.array(piece.size), 0.0
    if piece.kind == "cylinder":
        cover = cover_cylinder(*piece.size, inflation=inflation, most=most)
    else:
        cover = cover_box(piece.size, inflation=inflation, most=most)
    return cover.centers, np.full(len(cover.centers), cover.radius), cover.inflation


def _disabled(
    robot: Robot,
    urdf: Urdf,
    balls: Mapping[str, tuple[tuple[Array, float], ...]],
    geometry: Mapping[str, list[Geometry]],
) -> tuple[tuple[str, str, str], ...]:
    frames = {frame.name: frame for frame in robot.frames}
    adjacent = {frozenset((a, b)) for _, a, b in urdf.joints}
    rows = [(a, b, "adjacent") for a, b in combinations(balls, 2) if {a, b} in adjacent]
    spheres = placed_spheres(balls, frames)
    pairs = checked_pairs(spheres, frozenset(adjacent))
    sampled = _Sampled(replace(robot, spheres=spheres, self_pairs=pairs))
    always = f"spheres overlap in each of {POSTURES} random postures"
    never = f"geometry touches in none of {POSTURES} random postures (sampled)"
    for first, second in pairs:
        share = sampled.overlap(first, second)
        if share == 1.0:
            rows.append((first, second, always))
        elif share > 0.0 and sampled.joints_between(first, second) <= NEIGHBOURS:
            poses = sampled.poses(first, second)
            if not ever_touch(geometry[first], geometry[second], poses):
                rows.append((first, second, never))
    return tuple(rows)


class _Sampled:
    """A robot with spheres in ``POSTURES`` random postures.

    Args:
        robot: the robot.
    """

    def __init__(self, robot: Robot) -> None:
        import casadi as ca

        self.robot, self.kin = robot, Kinematics(robot)
        low = np.where(np.isfinite(robot.limits.lower), robot.limits.lower, -np.pi)
        high = np.where(np.isfinite(robot.limits.upper), robot.limits.upper, np.pi)
        rng = np.random.default_rng(SEED)
        self.q = rng.uniform(low, high, (POSTURES, robot.nv))
        centres = ca.Function("c", [self.kin.q], [self.kin.sphere_centres()])
        at = np.array(centres.map(POSTURES)(self.q.T)).T
        self.at: Array = at.reshape(POSTURES, -1, 3)
        self.radii = np.array([sphere.radius for sphere in robot.spheres])
        self.of: dict[str, list[int]] = {}
        for index, sphere in enumerate(robot.spheres):
            self.of.setdefault(sphere.link, []).append(index)

    def overlap(self, first: str, second: str) -> float:
        """Share of the postures in which spheres of two links overlap."""
        i, j = self.of[first], self.of[second]
        away = np.linalg.norm(self.at[:, i, None] - self.at[:, None, j], axis=3)
        room = away - self.radii[i][:, None] - self.radii[j]
        return float(np.mean(room.min(axis=(1, 2)) < 0.0))

    def joints_between(self, first: str, second: str) -> int:
        """Number of joints that move one of two links relative to the other."""
        tree = self.robot.tree
        a, b = (set(tree.ancestors(self.robot.frame(n).joint)) for n in (first, second))
        return len(a ^ b)

    def poses(self, first: str, second: str) -> list[tuple[Array, Array]]:
        """Poses (4, 4) of two links' frames in every posture."""
        import casadi as ca

        both = [self.kin.pose(first), self.kin.pose(second)]
        evaluate = ca.Function("both", [self.kin.q], both)
        found = (evaluate(q) for q in self.q)
        return [(np.array(a), np.array(b)) for a, b in found]
