"""Docstrings say what the code does: they exist, and name what is raised."""

import re

import pytest

from tests.docstrings import House
from tests.syntax import arguments, documented, methods, parameters

QUIET = ("__getattr__",)
"""A module's protocol with Python: AttributeError and nothing else."""


def public(house):
    """What the rooms export, as (module, name, syntax tree), each once."""
    for room in (m for name, m in house.modules.items() if name.count(".") == 1):
        for name in room.exported:
            found = house.find(room.name, name)
            if found is not None:
                yield found[0], name, found[1]


def every(house):
    """All functions and methods with what their docstring and class document."""
    for module in house.modules.values():
        for function in house.functions(module):
            own = documented(function.text)
            owner = module.classes.get(function.owner)
            whole = own | (documented(house.text(owner)) if owner else set())
            yield function, own, whole


def hidden(function):
    names = (function.owner, function.node.name)
    return any(n.startswith("_") and not n.startswith("__") for n in names)


def silent(house):
    """Exported functions, classes, methods and properties without a docstring."""
    for module, name, node in public(house):
        if not house.text(node):
            yield f"{module}.{name}"
        for method in methods(node) if hasattr(node, "bases") else ():
            if not method.name.startswith("_") and not house.text(method):
                yield f"{module}.{name}.{method.name}"


def kin(house, function, name):
    known = house.bases(function.module, name)
    return known or house.bases("rrnn_opt.errors", name)


def never_raised(house):
    """What a docstring promises and nothing that the function uses raises."""
    for function, own, _ in every(house):
        possible = [kin(house, function, n) for n in house.possible(function)]
        for name in sorted(own):
            if not any(name in names for names in possible):
                yield f"{function.name}: {name}"


def kept_secret(house):
    """What a function that is not private raises itself and does not document."""
    for function, _, told in every(house):
        if hidden(function) or function.node.name in QUIET:
            continue
        for name in sorted(house.raises(function)):
            if not name.startswith("_") and not kin(house, function, name) & told:
                yield f"{function.name}: {name}"


def foreign(house):
    """Errors, not the package's own nor the disk's, that an exported name raises."""
    exported = {(module, name) for module, name, _ in public(house)}
    for function, _, _ in every(house):
        if (function.module, function.owner or function.node.name) in exported:
            for name in sorted(house.raises(function)):
                names = kin(house, function, name)
                if "Exception" in names and not names & {"RrnnError", "OSError"}:
                    yield f"{function.name}: {name}"


def misnamed(house):
    """Parameters that a list of arguments leaves out, and entries that are none."""
    for function, _, _ in every(house):
        listed = arguments(function.text)
        given = parameters(function.node) - {"self", "cls"}
        if listed and listed != {name for name in given if name[0] != "_"}:
            yield f"{function.name}: {sorted(listed ^ given)}"


def unlisted(house):
    """Exported functions of several parameters that do not say what these are.

    Another method of the name may say so (a protocol's), or one that is referred to.
    """
    exported = {(module, name) for module, name, _ in public(house)}
    for function, _, _ in every(house):
        names = parameters(function.node) - {"self", "cls"}
        shown = (function.module, function.owner or function.node.name) in exported
        if not shown or function.node.name.startswith("_") or len(names) < 2:
            continue
        same = house.by_name[function.node.name]
        told = any(arguments(f.text) >= names for f in same)
        if not (told or re.search(":(func|meth):", function.text)):
            yield function.name


def test_every_public_name_has_a_docstring(house):
    assert list(silent(house)) == []


def test_what_is_documented_can_be_raised(house):
    assert list(never_raised(house)) == []


def test_what_is_raised_is_documented(house):
    assert list(kept_secret(house)) == []


def test_what_the_rooms_export_raises_errors_of_the_package_only(house):
    assert list(foreign(house)) == []


def test_listed_arguments_are_the_parameters(house):
    assert list(misnamed(house)) == []


def test_several_parameters_are_listed(house):
    assert list(unlisted(house)) == []


def test_enough_is_looked_at(house):
    """The checks above are not of nothing."""
    assert len({(module, name) for module, name, _ in public(house)}) > 200
    assert sum(len(own) for _, own, _ in every(house)) > 200
    assert sum(bool(house.raises(f)) for f, _, _ in every(house)) > 200


SMALL = '''
from rrnn_opt.errors import RrnnError

__all__ = ["root"]

def root(x):
    """A root.

    Args:
        x: not negative.

    Raises:
        RrnnError: x is negative.
    """
    return _root(x)

def _root(x):
    if x < 0:
        raise RrnnError("x is negative")
    return x ** 0.5
'''
ERRORS = (
    "class RrnnError(Exception):\n    pass\n\nclass FarError(RrnnError):\n    pass\n"
)
CHECKS = (silent, never_raised, kept_secret, foreign, misnamed, unlisted)


def found_in(text):
    house = House({"rrnn_opt.small": text, "rrnn_opt.errors": ERRORS})
    return {check for check in CHECKS for row in check(house) if "small" in row}


@pytest.mark.parametrize(
    ("before", "after", "finds"),
    [
        ("", "", set()),
        (re.escape('"""A root.'), 'x = """', {silent, kept_secret}),
        ("        x: not", "        y: not", {misnamed}),
        (r"def root\(x\)", "def root(x, y)", {misnamed, unlisted}),
        ("        RrnnError: x is negative.", "        The rest.", {kept_secret}),
        ("RrnnError: x", "KeyboardInterrupt: x", {never_raised, kept_secret}),
        ("RrnnError: x", "NoSuchError: x", {never_raised, kept_secret}),
        ("RrnnError: x", "FarError: x", {never_raised, kept_secret}),
        (r'raise RrnnError\("x is negative"\)', "return None", {never_raised}),
        (r"return _root\(x\)", "return x", {never_raised}),
        ("raise RrnnError", "raise KeyError", {kept_secret, never_raised, foreign}),
        (
            r"    return _root\(x\)",
            "    try:\n        return _root(x)\n    except RrnnError:\n        pass",
            set(),
        ),
    ],
)
def test_a_planted_lie_is_found(before, after, finds):
    text = re.sub(before, lambda _: after, SMALL, count=1)
    assert found_in(text) == finds


def test_a_dropped_section_is_found_in_the_package_itself(sources):
    name = "rrnn_opt.emit.prologue"
    told = "    Raises:\n        RrnnError: it names none.\n"
    assert told in sources[name]
    few = {key: sources[key] for key in (name, "rrnn_opt.errors")}
    mutant = House(few | {name: few[name].replace(told, "")})
    assert set(kept_secret(House(few))) == set()
    secrets = {f"{name}.require_{what}: RrnnError" for what in ("real", "trig")}
    assert set(kept_secret(mutant)) == secrets
