"""What docstrings say is raised, held against what the source raises.

Read from the source alone.  For each function two sets are known:

* ``raises``: what its own body, and the private functions of its module that it
  uses, raise and do not catch.  Nothing is guessed, so each one must be
  documented, by its own name or by that of a base class.
* ``possible``: what anything that its body names, anywhere in the package, could
  raise; a method is known by its name only.  Too much rather than too little, so
  what is documented and not among them is certainly not raised.
"""

import ast
import builtins
from collections.abc import Iterator
from functools import cached_property

from tests.syntax import Definition, Function, Module, methods

BY_ITSELF = {
    ast.Subscript: {"KeyError", "IndexError"},
    ast.Import: {"ImportError"},
    ast.ImportFrom: {"ImportError"},
    ast.Call: {"TypeError", "ValueError", "OSError"},
}
"""What Python itself raises at a node of this kind."""


class House:
    """All modules of the package, and who raises what."""

    def __init__(self, sources: dict[str, str]) -> None:
        self.modules = {n: Module(n, ast.parse(s)) for n, s in sources.items()}
        self.by_name: dict[str, list[Function]] = {}
        for module in self.modules.values():
            for function in self.functions(module):
                self.by_name.setdefault(function.node.name, []).append(function)

    @staticmethod
    def text(node: Definition) -> str:
        return ast.get_docstring(node) or ""

    @staticmethod
    def functions(module: Module) -> Iterator[Function]:
        for node in module.functions.values():
            yield Function(module.name, "", node)
        for owner in module.classes.values():
            for node in methods(owner):
                yield Function(module.name, owner.name, node)

    def find(self, module: str, name: str) -> tuple[str, Definition] | None:
        """Where a name of a module is defined, through any imports."""
        for _ in range(9):
            there = self.modules.get(module)
            if there is None:
                return None
            node = there.functions.get(name) or there.classes.get(name)
            if node is not None:
                return module, node
            if name not in there.imported:
                return None
            module, name = there.imported[name]
        return None

    def bases(self, module: str, name: str) -> set[str]:
        """An exception's name and those of all its bases; none for what is none."""
        known = getattr(builtins, name, None)
        if isinstance(known, type) and issubclass(known, BaseException):
            return {c.__name__ for c in known.__mro__}
        found = self.find(module, name)
        if found is None or not isinstance(found[1], ast.ClassDef):
            return set()
        above = [self.bases(found[0], ast.unparse(b)) for b in found[1].bases]
        return set().union({name}, *above) if any(above) else set()

    def raises(
        self, function: Function, seen: frozenset[str] = frozenset()
    ) -> set[str]:
        """What its body and its module's private functions raise and do not catch."""
        if function.name in seen:
            return set()
        walk = _Walk(self, function, seen | {function.name})
        for part in function.node.body:
            walk.visit(part)
        return walk.found

    def possible(self, function: Function) -> set[str]:
        """Every exception that anything it names, near or far, could raise."""
        return self._reached[function.name]

    @cached_property
    def _reached(self) -> dict[str, set[str]]:
        """By function, and by ".name" for all methods of a name: a fixed point."""
        every = [f for same in self.by_name.values() for f in same]
        named = {f.name: self._named(f) for f in every}
        named |= {f".{n}": {f.name for f in same} for n, same in self.by_name.items()}
        reached = {name: set() for name in named}
        reached |= {f.name: self._thrown(f) for f in every}
        growing = True
        while growing:
            growing = False
            for name, others in named.items():
                more = set().union(reached[name], *(reached.get(o, ()) for o in others))
                growing |= len(more) > len(reached[name])
                reached[name] = more
        return reached

    def _thrown(self, function: Function) -> set[str]:
        """What its own text, helpers inside included, can raise."""
        nodes = list(ast.walk(function.node))
        raised = (node.exc for node in nodes if isinstance(node, ast.Raise))
        stated = (self.raised_by(function.module, node) for node in raised if node)
        return set().union(*stated, *(BY_ITSELF.get(type(n), ()) for n in nodes))

    def _named(self, function: Function) -> set[str]:
        """Functions, and "." with the names of methods, that a body mentions.

        An abstract method stands for all methods of its name.
        """
        words = {ast.unparse(d) for d in function.node.decorator_list}
        found = {f".{function.node.name}"} if "abstractmethod" in words else set()
        for node in ast.walk(function.node):
            if isinstance(node, ast.Attribute):
                found.add(f".{node.attr}")
            elif isinstance(node, ast.Name):
                found |= {f.name for f in self._meant(function.module, node.id)}
        return found

    def raised_by(self, module: str, node: ast.expr) -> set[str]:
        """What ``raise node`` can mean: a class, or what its maker promises."""
        called = node.func if isinstance(node, ast.Call) else node
        if isinstance(called, ast.Attribute):
            options = self.by_name.get(called.attr, [])
            promised = {ast.unparse(f.node.returns) for f in options if f.node.returns}
            return {n for n in promised if self.bases(module, n)}
        if not isinstance(called, ast.Name):
            return set()
        if self.bases(module, called.id):
            return {called.id}
        maker = self.find(module, called.id)
        if maker is None or not isinstance(maker[1], ast.FunctionDef):
            return set()
        promise = ast.unparse(maker[1].returns) if maker[1].returns else ""
        return {promise} if self.bases(maker[0], promise) else set()

    def _meant(self, module: str, name: str) -> list[Function]:
        found = self.find(module, name)
        if found is None:
            return []
        where, node = found
        if isinstance(node, ast.FunctionDef):
            return [Function(where, "", node)]
        return [Function(where, node.name, m) for m in methods(node)]


class _Walk(ast.NodeVisitor):
    """Statements in order, with what the ``try`` around them catches."""

    def __init__(self, house: House, function: Function, seen: frozenset[str]) -> None:
        self.house, self.function, self.seen = house, function, seen
        self.caught: list[set[str]] = []
        self.found: set[str] = set()

    def visit_Try(self, node: ast.Try) -> None:
        words = [h.type for h in node.handlers]
        names = {
            n.id for w in words if w for n in ast.walk(w) if isinstance(n, ast.Name)
        }
        self.caught.append(names | ({"BaseException"} if None in words else set()))
        for part in node.body:
            self.visit(part)
        self.caught.pop()
        for part in (*node.handlers, *node.orelse, *node.finalbody):
            self.visit(part)

    def visit_Raise(self, node: ast.Raise) -> None:
        if node.exc is not None:
            self._add(self.house.raised_by(self.function.module, node.exc))
        self.generic_visit(node)

    def visit_Name(self, node: ast.Name) -> None:
        if node.id.startswith("_"):
            self._follow(
                self.house.modules[self.function.module].functions.get(node.id), ""
            )

    def visit_Attribute(self, node: ast.Attribute) -> None:
        mine = isinstance(node.value, ast.Name) and node.value.id in ("self", "cls")
        owner = self.house.modules[self.function.module].classes.get(
            self.function.owner
        )
        if mine and owner is not None and node.attr.startswith("_"):
            known = {m.name: m for m in methods(owner)}
            self._follow(known.get(node.attr), owner.name)
        self.generic_visit(node)

    def _follow(self, node: ast.FunctionDef | None, owner: str) -> None:
        if node is not None:
            helper = Function(self.function.module, owner, node)
            self._add(self.house.raises(helper, self.seen))

    def _add(self, names: set[str]) -> None:
        for name in names:
            kin = self.house.bases(self.function.module, name) | {name}
            if not any(kin & caught for caught in self.caught):
                self.found.add(name)


def seen(check, sources: dict[str, str], name: str, line: str, instead: str):
    """Rows about a module of the package: as it is, and with one line changed."""
    assert line in sources[name]
    few = {key: sources[key] for key in (name.rpartition(".")[0], name)}
    changed = few | {name: few[name].replace(line, instead, 1)}
    return tuple([r for r in check(House(s)) if name in r] for s in (few, changed))
