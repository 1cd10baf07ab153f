"""Fit covering spheres to a URDF's geometry, and prove that they cover it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path
from typing import Any

from rrnn_opt.robot.fitting.apart import never_touch, path_joints
from rrnn_opt.robot.fitting.geometry import Geometry, collision_geometry
from rrnn_opt.robot.fitting.link_cover import CoveredLink, LinkCover
from rrnn_opt.robot.fitting.sampled import Sampled
from rrnn_opt.robot.fitting.self_contact import (
    Pair,
    PairContact,
    SelfContact,
    refine,
    self_contact,
)
from rrnn_opt.robot.loading.urdf import read_urdf
from rrnn_opt.robot.robot import Robot

POSTURES = 1000
"""Random postures in which pairs are looked at."""
NEIGHBOURS = 2
SEED = 0
SHARE = 0.005
"""Share of false contacts of a pair that is left alone."""
EXTRA = 96
ALWAYS = 0.99
"""Share of postures with overlapping spheres from which a pair cannot be checked."""


@dataclass(frozen=True)
class FittedSpheres:
    """Spheres of a whole URDF.

    Attributes:
        links: covers, in the file's order.
        disabled: (link, link, reason) pairs that should not be checked.
        visual: links whose visual geometry was taken for want of another.
        contact: how often checked links touch, in postures of their own.
        before: the same before spheres were added.
    """

    links: tuple[LinkCover, ...]
    disabled: tuple[tuple[str, str, str], ...]
    visual: tuple[str, ...]
    contact: SelfContact
    before: SelfContact

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
    extra: int = EXTRA,
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
        extra: spheres added at most where links pass each other more closely
            than the bulges leave room for, so that spheres overlap in postures
            in which the geometry is apart.
        folders: where ``package://`` paths may start.

    Returns:
        Covers and disabled pairs, each with its reason: links that a joint
        connects; links at most ``NEIGHBOURS`` joints apart whose geometry is
        apart in all postures between the limits, proved by branch and bound, or
        in ``POSTURES`` random ones, where that proof is not finished; links
        whose geometry touches in all random postures, or whose spheres as first
        fitted overlap in ``ALWAYS`` of them: checking would forbid nearly all.

    Raises:
        RobotError: the file or a mesh cannot be read.
    """
    urdf = read_urdf(path)
    geometry, visual = collision_geometry(urdf, folders)
    links = {
        name: CoveredLink(name, pieces, inflation, most)
        for name, pieces in geometry.items()
    }
    robot = Robot.from_urdf(path, tip=tip, tips=tips)
    adjacent = {frozenset((a, b)) for _, a, b in urdf.joints}
    seen, fresh = (Sampled(robot, links, POSTURES, SEED + k) for k in range(2))
    moving = _moving(robot, tuple(links), adjacent)
    contacts = [PairContact(links[a], links[b], geometry, seen) for a, b in moving]
    others = [PairContact(links[a], links[b], geometry, fresh) for a, b in moving]
    unchecked = _unchecked(robot, contacts, geometry)
    checked = set(moving) - set(unchecked)
    before = _self_contact(others, checked)
    kept = [c for c in contacts if c.names not in unchecked]
    refine(kept, extra=extra, share=SHARE)
    for contact in others:
        contact.look()
    rows = [(a, b, "adjacent") for a, b in combinations(links, 2) if {a, b} in adjacent]
    rows += [(*pair, why) for pair, why in unchecked.items()]
    return FittedSpheres(
        tuple(link.cover() for link in links.values()),
        tuple(rows),
        tuple(visual),
        _self_contact(others, checked),
        before,
    )


def _self_contact(contacts: Sequence[PairContact], checked: set[Pair]) -> SelfContact:
    """How often checked pairs touch as their spheres are now."""
    marks = ((c.overlap, c.touch) for c in contacts if c.names in checked)
    return self_contact(marks, POSTURES)


def _unchecked(
    robot: Robot,
    contacts: Sequence[PairContact],
    geometry: Mapping[str, list[Geometry]],
) -> dict[Pair, str]:
    """Pairs that should not be checked, in their order, and why."""
    never = _never(robot, contacts, geometry)
    reasons = {c.names: never.get(c.names) or _always(c) for c in contacts}
    return {pair: why for pair, why in reasons.items() if why}


def _moving(
    robot: Robot, links: Sequence[str], adjacent: set[frozenset[str]]
) -> list[Pair]:
    """Links on different joints that no joint connects."""
    joint = {name: robot.frame(name).joint for name in links}
    return [
        (a, b)
        for a, b in combinations(links, 2)
        if joint[a] != joint[b] and frozenset((a, b)) not in adjacent
    ]


def _never(
    robot: Robot,
    contacts: Sequence[PairContact],
    geometry: Mapping[str, list[Geometry]],
) -> dict[Pair, str]:
    """Neighbours of which only spheres overlap, and how that is known."""
    found: dict[Pair, str] = {}
    for contact in contacts:
        near = len(path_joints(robot, *contact.names)) <= NEIGHBOURS
        if not near or contact.touch.any() or not contact.overlap.any():
            continue
        proof = never_touch(robot, *contact.names, geometry)
        gap = f"{1e3 * proof.gap:.1f} mm"
        if proof.verdict == "apart":
            found[contact.names] = f"geometry never touches (proved, least gap {gap})"
        elif proof.verdict == "undecided":
            found[contact.names] = (
                f"geometry touches in none of {POSTURES} random postures"
                f" (sampled, least gap {gap})"
            )
    return found


def _always(contact: PairContact) -> str:
    """Why a pair cannot be checked, or nothing."""
    if contact.touch.all():
        return f"geometry touches in each of {POSTURES} random postures"
    if (share := float(contact.overlap.mean())) >= ALWAYS:
        return (
            f"spheres overlap in {share:.1%} of {POSTURES} random postures,"
            f" geometry touches in {contact.touch.mean():.1%}"
        )
    return ""
