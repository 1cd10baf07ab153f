"""What docstrings say of numbers: the shape of arrays, the unit of quantities.

Read from the source.  A number is a parameter, a field of a dataclass, or what
is returned; what is said of it is its entry in ``Args`` or ``Attributes``, or
the section ``Returns``, or without one the words before the first section.
Methods say it once: one that says nothing inherits the words of its base class.
"""

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass

from tests.docstrings import House
from tests.syntax import Definition, entries, methods, paragraph

SECTIONS = ("Args", "Attributes", "Returns", "Yields", "Raises", "Source")
ARRAY = re.compile(r"\b(Array|ArrayLike|NDArray|ndarray|SX|Index|Value|Part)\b")
HOLDER = re.compile(r"\b(dict|Mapping|Callable)\[.*")
"""Annotations of collections by name, whose parts have shapes of their own."""

DIMENSION = r"(?:\d+|\d*[a-zA-Z]|nv|nj|ns|meq|mineq|rows|columns|size|count)"
EXTENT = rf"{DIMENSION}(?: ?[+*-] ?{DIMENSION})*"
SHAPE = re.compile(
    rf"\({EXTENT},(?: {EXTENT}(?:, {EXTENT})*)?\)"
    r"|\bscalar\b|\bany (?:shape|column)\b|\b(?:shape|form) of\b|\bof its shape\b"
    r"|``(?:\w+\.)?shape``|\b4x4\b"
)
"""``(n,)``, ``(3k, nv)``; a scalar; whatever another thing has."""

ONE = r"(?:rad|m|s|us|mm|kg)\d?"
UNIT = re.compile(
    rf"(?:^|[,;:(] ?|\b(?:or|and|of|in) )(?:1/{ONE}|1/\({ONE} {ONE}\)"
    rf"|{ONE}(?:/(?:{ONE}|\({ONE} {ONE}\)))?|[Ss]econds|turns|degrees)(?![\w/^*'-])"
)
"""A unit where a unit may stand: first, after a comma, or beside another unit."""

PURE = re.compile(
    r"(?:^|[,;] )1(?=[.,;]|$)|\b[Ss]hare\b|\b[Rr]atio\b|\b[Pp]robabilit|\b[Ff]actor\b"
    r"|\b(?:[Uu]nit|outward) (?:\w+ )?(?:axis|axes|normals?|columns?|length|of)\b"
    r"|\b[Oo]rientation\b|\b[Rr]otation\b|\b[Aa]xes\b|\b[Ii]nd(?:ex|ices)\b"
    r"|\b[Aa]ctivit|\bunits? of\b|\bno unit\b"
)
"""What says that a number has no unit, or that of another one."""

MEASURED = re.compile(
    r"(?:^|_)(?:q0?|qd|qdd|time|duration|period|velocity|velocities|acceleration"
    r"|distance|clearance|margin|radius|half_widths?|dt|h|epsilon|kappa|damping|seconds)$"
)
"""Names of quantities: these have a unit wherever they stand."""

CARRIES = re.compile(r"_(?:s|us|m|rad)$")
"""A name that ends in its unit needs no other word."""


@dataclass(frozen=True)
class Number:
    """One number or array of the public interface.

    Attributes:
        room: e.g. "rrnn_opt.motion".
        owner: dotted name of the class or function.
        name: of the parameter or field; "" for what is returned.
        kind: its annotation.
        said: what the docstring says of it.
    """

    room: str
    owner: str
    name: str
    kind: str
    said: str

    def __str__(self) -> str:
        return f"{self.owner}({self.name})" if self.name else f"{self.owner} ->"

    @property
    def is_array(self) -> bool:
        return bool(ARRAY.search(HOLDER.sub("", self.kind)))

    @property
    def is_float(self) -> bool:
        return bool(re.search(r"\bfloat\b", HOLDER.sub("", self.kind)))

    @property
    def has_shape(self) -> bool:
        return bool(SHAPE.search(self.said))

    @property
    def has_unit(self) -> bool:
        named = CARRIES.search(self.name or self.owner)
        return bool(named or UNIT.search(self.said) or PURE.search(self.said))

    @property
    def is_measured(self) -> bool:
        return bool(MEASURED.search(self.name))


def exported(house: House) -> Iterator[tuple[str, str, str, Definition]]:
    """What the rooms export, each once: (room, module, name, syntax tree)."""
    seen = set()
    for room in (m for name, m in house.modules.items() if name.count(".") == 1):
        for name in room.exported:
            found = house.find(room.name, name)
            if found is not None and (found[0], name) not in seen:
                seen.add((found[0], name))
                yield room.name, found[0], name, found[1]


def numbers(house: House) -> Iterator[Number]:
    """Every annotated parameter, field and result of what the rooms export."""
    for room, module, name, node in exported(house):
        owner = f"{module}.{name}"
        if isinstance(node, ast.FunctionDef):
            yield from _of_function(room, owner, node, [house.text(node)])
            continue
        line = list(lineage(house, module, node))
        yield from _of_fields(house, room, owner, line)
        for method in methods(node):
            if method.name == "__call__" or not method.name.startswith("_"):
                same = (m for c in line for m in methods(c) if m.name == method.name)
                texts = [house.text(m) for m in same]
                yield from _of_function(room, f"{owner}.{method.name}", method, texts)


def lineage(house: House, module: str, node: ast.ClassDef) -> Iterator[ast.ClassDef]:
    """A class and its bases in the package, nearest first."""
    yield node
    for base in node.bases:
        found = house.find(module, ast.unparse(base).split("[")[0])
        if found is not None and isinstance(found[1], ast.ClassDef):
            yield from lineage(house, found[0], found[1])


def fields(node: ast.ClassDef) -> dict[str, str]:
    """Annotations of a class's public fields, in order."""
    found = {
        ast.unparse(part.target): ast.unparse(part.annotation)
        for part in node.body
        if isinstance(part, ast.AnnAssign)
    }
    return {
        name: kind
        for name, kind in found.items()
        if not name.startswith("_") and "ClassVar" not in kind
    }


def _of_fields(
    house: House, room: str, owner: str, line: list[ast.ClassDef]
) -> Iterator[Number]:
    told = [entries(house.text(c), "Attributes") for c in line]
    for name, kind in fields(line[0]).items():
        said = next((entry[name] for entry in told if name in entry), "")
        yield Number(room, owner, name, kind, said)


def _of_function(
    room: str, owner: str, node: ast.FunctionDef, texts: list[str]
) -> Iterator[Number]:
    told = [entries(text, "Args") for text in texts]
    given = (*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs)
    for argument in given:
        if argument.arg not in ("self", "cls") and argument.annotation is not None:
            said = next((e[argument.arg] for e in told if argument.arg in e), "")
            kind = ast.unparse(argument.annotation)
            yield Number(room, owner, argument.arg, kind, said)
    if node.returns is not None:
        kind, said = ast.unparse(node.returns), " ".join(map(_result, texts))
        yield Number(room, owner, "", kind, said)


def _result(text: str) -> str:
    heads = "|".join(SECTIONS)
    before = re.split(rf"\n(?:{heads}):", text)[0]
    return paragraph(text, "Returns") or " ".join(before.split())
