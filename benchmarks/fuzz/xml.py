"""URDF texts: changed as trees or as text, and tricks that XML is known for."""

from __future__ import annotations

import copy
import random
import xml.etree.ElementTree as ET
from collections.abc import Callable

from benchmarks.fuzz import mutation

BOMB = (
    '<?xml version="1.0"?><!DOCTYPE r [<!ENTITY a "ha">'
    + "".join(
        f'<!ENTITY {b} "{f"&{a};" * 10}">'
        for a, b in zip("abcdefghi", "bcdefghij", strict=True)
    )
    + "]><robot name='&j;'><link name='x'/></robot>"
)
OUTSIDE = (
    "<!DOCTYPE r [<!ENTITY x SYSTEM 'file:///etc/passwd'>]>"
    "<robot name='r'><link name='&x;'/></robot>"
)
VALUES = (
    *("nan nan nan", "inf 0 0", "1 2", "0 0 0", "1e999 0 0", "a b c", "1 2 3 4", ""),
    *("0 0 1e-300", "3 4 5", "1e300 0 0", "-0 0 0", "1,0,0", "0x10 0 0", "1 0 0"),
    *("revolute", "floating", "planar", "fixed", "hand", "base", "upper", "j1"),
    *("nan", "inf", "-1", "1e400", "0", "-5", "1_0", "٣", "grip"),
)
NAMES = tuple(n for n in mutation.NAMES if "\x00" not in n and n != "\ud800")


def robot(rng: random.Random, base: str) -> bytes:
    """A URDF that is wrong somewhere."""
    what = rng.randrange(10)
    if what == 0:
        return rng.choice(TRICKS)(rng).encode("utf-8", "surrogatepass")
    if what == 1:
        return mutation.raw(rng, base.encode())
    if what <= 3:
        return mutation.characters(rng, base).encode("utf-8", "surrogatepass")
    return _tree(rng, base)


def with_mesh(rng: random.Random, base: str) -> bytes:
    """A URDF whose sphere became a mesh, then perhaps changed."""
    name = rng.choice(("part.stl", "part.stl", "part.obj", "file://part.stl"))
    if rng.random() < 0.2:
        name = rng.choice(("", "..", "nowhere.stl", "package://a/b.stl", "/dev/zero"))
    scale = rng.choice(("", 'scale="1 1 1"', 'scale="nan 1 1"', 'scale="1 1"'))
    shape = rng.choice(
        (
            f'<mesh filename="{name}" {scale}/>',
            f'<mesh filename="{name}"/>',
            '<box size="1 1"/>',
            '<cylinder radius="-1" length="nan"/>',
        )
    )
    kind = rng.choice(("visual", "collision"))
    part = f'<{kind}><origin xyz="0 0"/><geometry>{shape}</geometry></{kind}>'
    if rng.random() < 0.7:
        part = part.replace('<origin xyz="0 0"/>', "")
    return base.replace('<link name="hand"/>', f'<link name="hand">{part}</link>', 1)[
        :
    ].encode()


def _tree(rng: random.Random, base: str) -> bytes:
    root = ET.fromstring(base)
    for _ in range(rng.choice((1, 1, 1, 2, 4))):
        nodes = [(p, c) for p in root.iter() for c in p]
        if not nodes:
            break
        parent, child = rng.choice(nodes)
        what = rng.randrange(5)
        if what == 0:
            parent.remove(child)
        elif what == 1:
            parent.append(copy.deepcopy(rng.choice(nodes)[1]))
        elif what == 2 and child.attrib:
            del child.attrib[rng.choice(sorted(child.attrib))]
        elif what == 3:
            child.tag = rng.choice(("link", "joint", "limit", "mimic", "transmission"))
        elif child.attrib:
            key = rng.choice(sorted(child.attrib))
            child.set(key, rng.choice(VALUES if rng.random() < 0.7 else NAMES))
    return ET.tostring(root, encoding="utf-8")


def _chain(rng: random.Random) -> str:
    count = rng.choice((300, 2_000, 40_000))
    links = "".join(f'<link name="l{k}"/>' for k in range(count + 1))
    joints = "".join(
        f'<joint name="j{k}" type="continuous"><parent link="l{k}"/>'
        f'<child link="l{k + 1}"/><axis xyz="0 0 1"/></joint>'
        for k in range(count)
    )
    return f'<robot name="chain">{links}{joints}</robot>'


def _cycle(rng: random.Random) -> str:
    ends = rng.choice(
        (("a", "b", "b", "a"), ("a", "a", "b", "b"), ("a", "b", "a", "b"))
    )
    joints = "".join(
        f'<joint name="j{k}" type="fixed"><parent link="{ends[2 * k]}"/>'
        f'<child link="{ends[2 * k + 1]}"/></joint>'
        for k in range(2)
    )
    root = rng.choice(("", '<link name="root"/>'))
    return f'<robot name="c">{root}<link name="a"/><link name="b"/>{joints}</robot>'


def _mimics(rng: random.Random) -> str:
    """Joints that follow each other in a ring."""
    joints = "".join(
        f'<joint name="j{k}" type="continuous"><parent link="l{k}"/>'
        f'<child link="l{k + 1}"/><axis xyz="0 0 1"/><mimic joint="j{(k + 1) % 3}"'
        f' multiplier="{rng.choice(("1", "nan", "1e200", "0"))}"/></joint>'
        for k in range(3)
    )
    links = "".join(f'<link name="l{k}"/>' for k in range(4))
    return f'<robot name="ring">{links}{joints}</robot>'


def _nested(rng: random.Random) -> str:
    depth = rng.choice((500, 20_000, 200_000))
    return f"<robot name='n'>{'<a>' * depth}{'</a>' * depth}<link name='x'/></robot>"


TRICKS: tuple[Callable[[random.Random], str], ...] = (
    lambda rng: BOMB,
    lambda rng: OUTSIDE,
    _chain,
    _cycle,
    _mimics,
    _nested,
    lambda rng: "<robot/>",
    lambda rng: "<robot name='r'>" + "<link name='x'/>" * 2 + "</robot>",
    lambda rng: "<sdf><model/></sdf>",
    lambda rng: "<robot xmlns:xacro='x'><xacro:macro/></robot>",
    lambda rng: (
        "<?xml version='1.0' encoding='utf-16'?><robot><link name='a'/></robot>"
    ),
    lambda rng: "<!doctype r><robot><link name='a'/></robot>",
    lambda rng: "<robot>" + "<link name='a' " + "x='1' " * 2000 + "/></robot>",
    lambda rng: "<robot name='" + "n" * 10**6 + "'><link name='a'/></robot>",
)
