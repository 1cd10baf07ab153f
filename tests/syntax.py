"""Modules as syntax trees: what they define, import and say of themselves."""

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

Definition = ast.FunctionDef | ast.ClassDef
SECTION = r"^{}:\n((?: {{4}}.*\n|\s*\n)*)"
ENTRY = re.compile(r"^(\w+(?:, \w+)*):", re.MULTILINE)


def documented(text: str) -> set[str]:
    """Names in the ``Raises`` section of a docstring."""
    entries = ENTRY.findall(_section(text, "Raises"))
    return {name for entry in entries for name in entry.split(", ")}


def arguments(text: str) -> set[str]:
    """Names in the ``Args`` section of a docstring."""
    return set(re.findall(r"^\*{0,2}(\w+):", _section(text, "Args"), re.MULTILINE))


def entries(text: str, title: str) -> dict[str, str]:
    """What one section says of each name; several names may share an entry."""
    said: dict[str, str] = {}
    names: list[str] = []
    for line in _section(text, title).splitlines():
        opens = re.match(r"\*{0,2}(\w+(?:, \w+)*): *(.*)", line)
        if opens:
            names, line = opens[1].split(", "), opens[2]
        said |= {name: f"{said.get(name, '')} {line.strip()}".strip() for name in names}
    return said


def paragraph(text: str, title: str) -> str:
    """A section that is plain text, in one line."""
    return " ".join(_section(text, title).split())


def _section(text: str, title: str) -> str:
    """The entries of one section, continued lines further in."""
    found = re.search(SECTION.format(title), text + "\n", re.MULTILINE)
    lines = [line for line in found[1].splitlines() if line.strip()] if found else []
    return "\n".join(line[4:] for line in lines)


def parameters(node: ast.FunctionDef) -> set[str]:
    known = node.args
    every = [*known.posonlyargs, *known.args, *known.kwonlyargs]
    return {a.arg for a in (*every, known.vararg, known.kwarg) if a is not None}


@dataclass(frozen=True)
class Function:
    """A function, method or property where it stands.

    Attributes:
        module: dotted name.
        owner: class it belongs to, or "".
        node: its syntax tree.
    """

    module: str
    owner: str
    node: ast.FunctionDef

    @property
    def name(self) -> str:
        return ".".join(
            part for part in (self.module, self.owner, self.node.name) if part
        )

    @property
    def text(self) -> str:
        return ast.get_docstring(self.node) or ""


@dataclass
class Module:
    """One source file: what it defines, and what its names stand for."""

    name: str
    tree: ast.Module
    functions: dict[str, ast.FunctionDef] = field(default_factory=dict)
    classes: dict[str, ast.ClassDef] = field(default_factory=dict)
    imported: dict[str, tuple[str, str]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for node in self.tree.body:
            if isinstance(node, ast.FunctionDef):
                self.functions[node.name] = node
            elif isinstance(node, ast.ClassDef):
                self.classes[node.name] = node
        for node in ast.walk(self.tree):
            if isinstance(node, ast.ImportFrom) and node.module:
                for alias in node.names:
                    self.imported[alias.asname or alias.name] = node.module, alias.name

    @property
    def exported(self) -> list[str]:
        """What its ``__all__`` lists; without a list, its public definitions."""
        for node in self.tree.body:
            if (
                isinstance(node, ast.Assign)
                and ast.unparse(node.targets[0]) == "__all__"
            ):
                return [n.value for n in ast.walk(node) if isinstance(n, ast.Constant)]
        defined = (*self.functions, *self.classes)
        return [name for name in defined if not name.startswith("_")]


def methods(node: ast.ClassDef) -> Iterator[ast.FunctionDef]:
    return (part for part in node.body if isinstance(part, ast.FunctionDef))


def read_house(root: Path) -> dict[str, str]:
    """Source by dotted name of every module below the package's folder."""
    sources = {}
    for path in _files(root):
        parts = path.relative_to(root.parent).with_suffix("").parts
        name = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
        sources[name] = path.read_text("utf-8")
    return sources


def _files(folder: Path) -> Iterator[Path]:
    for path in sorted(folder.iterdir()):
        if path.is_dir() and path.name != "__pycache__":
            yield from _files(path)
        elif path.suffix == ".py":
            yield path
