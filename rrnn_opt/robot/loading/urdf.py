"""What we read from a URDF ourselves: structure, mimic joints, primitives.

The file is checked before any parser sees it (no DOCTYPE, no ENTITY, UTF-8)
and its tree before pinocchio does, so that each fault gets its own sentence.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from rrnn_opt.errors import DocumentError, RobotError
from rrnn_opt.files import read_text
from rrnn_opt.robot.loading.urdf_shapes import Primitive, collisions_of, floats

LARGEST = 32 * 1024 * 1024  # bytes
MOST = 1_000
"""Links and joints that are accepted at most."""
DEEPEST = 50
"""Nested elements; a URDF needs six."""
KINDS = ("revolute", "continuous", "prismatic", "fixed")
LIMITED = ("revolute", "prismatic")


@dataclass(frozen=True)
class Mimic:
    """Value of a joint that follows another: multiplier * source + offset."""

    source: str
    multiplier: float
    offset: float


@dataclass(frozen=True)
class Urdf:
    """A checked URDF.

    Attributes:
        path: where it was read.
        text: its XML.
        name: the robot's name.
        links: link names, in the file's order.
        joints: (name, parent link, child link), in the file's order.
        mimic: coupling of the joints that follow another.
        collisions: collision geometry of the links that have any.
    """

    path: str
    text: str
    name: str
    links: tuple[str, ...]
    joints: tuple[tuple[str, str, str], ...]
    mimic: dict[str, Mimic]
    collisions: dict[str, tuple[Primitive, ...]]

    @property
    def leaves(self) -> list[str]:
        """The links that carry no other link, in the file's order."""
        parents = {parent for _, parent, _ in self.joints}
        return [link for link in self.links if link not in parents]


def read_urdf(path: str | Path) -> Urdf:
    """Read a URDF and check its tree.

    Args:
        path: the file.

    Returns:
        What it says.

    Raises:
        RobotError: in one sentence, what is wrong with it.
    """
    where = str(path)
    text = _safe_text(Path(path), where)
    try:
        root = ET.fromstring(text)
    except ET.ParseError as error:
        raise RobotError(where, f"not well-formed XML: {error}") from None
    if root.tag != "robot":
        raise RobotError(where, f"not a URDF: its root is <{root.tag}>, not <robot>")
    _check_size(root, where)
    if any("xacro" in str(element.tag) for element in root):
        raise RobotError(where, "this is a xacro file; expand it with xacro first")
    try:
        return _urdf(root, text, where)
    except (KeyError, ValueError, AttributeError) as error:
        raise RobotError(
            where, f"an element is missing or malformed: {error}"
        ) from None


def _safe_text(path: Path, where: str) -> str:
    try:
        text = read_text(path, most=LARGEST)
    except DocumentError as error:
        raise RobotError(where, str(error).removeprefix(f"{where}: ")) from None
    upper = text.upper()
    if "<!DOCTYPE" in upper or "<!ENTITY" in upper:
        raise RobotError(where, "has a DOCTYPE or ENTITY, which a URDF needs not")
    return text


def _check_size(root: ET.Element, where: str) -> None:
    """Refuse what would overrun pinocchio's recursive readers."""
    level, depth = list(root), 1
    while level and depth <= DEEPEST:
        level, depth = [child for element in level for child in element], depth + 1
    if level:
        raise RobotError(where, f"elements are nested more than {DEEPEST} deep")
    for kind in ("link", "joint"):
        count = len(root.findall(kind))
        if count > MOST:
            raise RobotError(where, f"has {count} {kind}s; at most {MOST} are accepted")


def _urdf(root: ET.Element, text: str, where: str) -> Urdf:
    joints = tuple(_joints(root, where))
    links = tuple(link.attrib["name"] for link in root.findall("link"))
    _check_tree(links, joints, where)
    return Urdf(
        path=where,
        text=text,
        name=root.get("name", Path(where).stem),
        links=links,
        joints=joints,
        mimic=dict(_mimics(root, {name for name, _, _ in joints}, where)),
        collisions=collisions_of(root),
    )


def _joints(root: ET.Element, where: str) -> Iterator[tuple[str, str, str]]:
    for joint in root.findall("joint"):
        name, kind = joint.attrib["name"], joint.attrib["type"]
        if kind not in KINDS:
            known = ", ".join(KINDS)
            message = f"joint '{name}' is {kind}; only {known} joints are supported"
            raise RobotError(where, message)
        if kind in LIMITED and joint.find("limit") is None:
            raise RobotError(where, f"joint '{name}' is {kind} but has no <limit>")
        _check_numbers(joint)
        ends = (joint.find("parent"), joint.find("child"))
        parent, child = (end.attrib["link"] for end in ends if end is not None)
        yield name, parent, child


def _check_numbers(joint: ET.Element) -> None:
    """Where a joint stands and turns must be finite numbers."""
    for element in (*joint.findall("origin"), *joint.findall("axis")):
        for field in {"xyz", "rpy"} & set(element.attrib):
            floats(element.attrib[field], 3)


def _check_tree(
    links: tuple[str, ...], joints: tuple[tuple[str, str, str], ...], where: str
) -> None:
    """One root, every link reached once, every name used once."""
    if not links:
        raise RobotError(where, "has no links")
    names = [name for name, _, _ in joints]
    for what, given in (("link", list(links)), ("joint", names)):
        twice = sorted({name for name in given if given.count(name) > 1})
        if twice:
            raise RobotError(where, f"two {what}s are called '{twice[0]}'")
    parent_of: dict[str, str] = {}
    for name, parent, child in joints:
        if not {parent, child} <= set(links):
            raise RobotError(where, f"joint '{name}' names a link that is not there")
        if child in parent_of:
            raise RobotError(where, f"link '{child}' has two parents; not a tree")
        parent_of[child] = parent
    roots = [link for link in links if link not in parent_of]
    if len(roots) > 1:
        raise RobotError(where, f"has several roots: {', '.join(roots[:4])}")
    if not roots or not _all_reach(roots[0], parent_of):
        raise RobotError(where, "its joints form a cycle; a tree is needed")


def _all_reach(root: str, parent_of: dict[str, str]) -> bool:
    children: dict[str, list[str]] = {}
    for child, parent in parent_of.items():
        children.setdefault(parent, []).append(child)
    seen, waiting = 0, [root]
    while waiting:
        seen += 1
        waiting.extend(children.get(waiting.pop(), []))
    return seen == len(parent_of) + 1


def _mimics(
    root: ET.Element, names: set[str], where: str
) -> Iterator[tuple[str, Mimic]]:
    for joint in root.findall("joint"):
        mimic = joint.find("mimic")
        if mimic is None or joint.attrib["type"] == "fixed":
            continue
        name, source = joint.attrib["name"], mimic.attrib["joint"]
        if source not in names:
            raise RobotError(where, f"joint '{name}' mimics '{source}', not there")
        multiplier = float(mimic.get("multiplier", "1"))
        yield name, Mimic(source, multiplier, float(mimic.get("offset", "0")))
