"""Collision geometry of a URDF: spheres, cylinders, boxes, and meshes unread."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import dataclass

SIZES = {"sphere": ("radius",), "cylinder": ("radius", "length"), "box": ("size",)}


@dataclass(frozen=True)
class Primitive:
    """A collision geometry of a link.

    Attributes:
        kind: "sphere", "cylinder", "box", or "mesh" for all that is not one.
        size: radius; radius and length; three edges; nothing for a mesh; m.
        xyz: origin in the link's frame, m.
        rpy: roll, pitch and yaw, rad.
    """

    kind: str
    size: tuple[float, ...]
    xyz: tuple[float, ...]
    rpy: tuple[float, ...]


def collisions_of(root: ET.Element) -> dict[str, tuple[Primitive, ...]]:
    """By link, for the links that have any.

    Raises:
        ValueError: a number is missing, not finite, or a size not positive.
        KeyError: an attribute is missing.
    """
    shapes = {
        link.attrib["name"]: tuple(map(read_primitive, link.findall("collision")))
        for link in root.findall("link")
    }
    return {link: found for link, found in shapes.items() if found}


def read_primitive(collision: ET.Element) -> Primitive:
    """The geometry of a <collision> or <visual> element.

    Raises:
        ValueError: a number is missing, not finite, or a size not positive.
        KeyError: an attribute is missing.
    """
    origin = collision.find("origin")
    attributes = {} if origin is None else origin.attrib
    xyz = floats(attributes.get("xyz", "0 0 0"), 3)
    rpy = floats(attributes.get("rpy", "0 0 0"), 3)
    for kind, fields in SIZES.items():
        shape = collision.find(f"geometry/{kind}")
        if shape is not None:
            text = " ".join(shape.attrib[field] for field in fields)
            size = floats(text, 3 if kind == "box" else len(fields))
            if min(size) <= 0.0:
                raise ValueError(f"a {kind} needs positive sizes, not '{text}'")
            return Primitive(kind, size, xyz, rpy)
    return Primitive("mesh", (), xyz, rpy)


def floats(text: str, count: int) -> tuple[float, ...]:
    """So many finite numbers of an attribute.

    Raises:
        ValueError: they are not.
    """
    values = tuple(float(word) for word in text.split())
    if len(values) != count or any(not abs(v) < float("inf") for v in values):
        raise ValueError(f"'{text}' must be {count} finite numbers")
    return values
