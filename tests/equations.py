"""What docstrings say of formulas: the equation, its constants, where it is from.

An equation is an indented line, a span in double backticks, or a clause of the
text, that relates letters on both sides: ``d- <= u <= d+``, ``J_N = -diag(s) J``.
"""

import ast
import re
from collections.abc import Iterator

from tests.docstrings import House
from tests.quantities import SECTIONS, exported, fields, lineage
from tests.syntax import Definition, Function, entries, methods, paragraph

CONTENT = ("rrnn_opt.formulations", "rrnn_opt.networks")
"""Rooms whose exports are laws out of the literature."""

EXPRESSION = re.compile(r"(?<!list\[)\b(SX|Formulation|ClaimCase|NeuralDynamics)\b")
"""What a function returns that hands out a formula."""

PLACES = (
    *CONTENT,
    "rrnn_opt.robot",
    "rrnn_opt.scene.distance",
    "rrnn_opt.lyapunov",
    "rrnn_opt.simulation",
    "rrnn_opt.planning.kernel",
    "rrnn_opt.planning.rollout",
    "rrnn_opt.symbolic.lagrangian",
    "rrnn_opt.verification.catalogue",
)
"""Where formulas of robots, laws and bounds are made."""

SIDE = r"[\w|)\]'}+^-]"
RELATION = re.compile(rf"[A-Za-z]{SIDE}* *(?:==?|<=?|>=?|->) *[-|(\[{{\w]")
OPERATION = re.compile(r"[\w)'] ?[-+*/^] ?[\w(]|[\w)]'\w|\b(?:max|min|sqrt|sum|det)\b")
GREEK = "alpha|beta|gamma|delta|epsilon|kappa|lambda|omega|rho|sigma|theta"
SYMBOL = re.compile(
    rf"(?<![\w.])(?:[A-Za-z]\w?|[A-Za-z]\w*_\w+|\(\d+\w?\)|{GREEK})(?!\w)"
)
ENGLISH = frozenset(("a", "A", "as", "at", "by", "in", "is", "it", "no", "of", "or"))
ENGLISH |= {"to", "m", "s"}  # and units
YEAR = re.compile(r"\b(?:18|19|20)\d\d\b")
PLACE = re.compile(
    r"\beqs?\. \(|\([1-9]\d*\w?\)|\bsections? [IVX]|\bTable [IVX]|\[\d+\]"
)
OWN = re.compile(r"\b[Oo]urs?\b|\bour own\b|\bReconstructed\b")


def before_sections(text: str) -> str:
    """The words before ``Args`` and the like."""
    return re.split(rf"\n(?:{'|'.join(SECTIONS)}):", text)[0]


def spans(text: str) -> list[str]:
    """Indented lines and what stands in double backticks."""
    words = before_sections(text)
    indented = [row for row in words.splitlines()[1:] if row.startswith("    ")]
    return indented + re.findall(r"``([^`]+)``", words)


def has_equation(text: str) -> bool:
    """Whether some line or clause relates two sides, or a span is a formula."""
    words = re.sub(r"``[^`]*``", "", before_sections(text))
    return (
        any(RELATION.search(row) or OPERATION.search(row) for row in spans(text))
        or bool(RELATION.search(words))
        or "minimise" in words
    )


def letters(text: str) -> set[str]:
    """Names and equation numbers in formulas that stand apart from the words."""
    rows = (r for r in spans(text) if RELATION.search(r) or OPERATION.search(r))
    return set(re.findall(r"[A-Za-z_]\w*|\(\d+\w?\)", " ".join(rows)))


def constants(node: Definition) -> Iterator[str]:
    """Names of the numbers that one may set."""
    if isinstance(node, ast.ClassDef):
        yield from (name for name, kind in fields(node).items() if "float" in kind)
        return
    for argument in (*node.args.args, *node.args.kwonlyargs):
        kind = ast.unparse(argument.annotation) if argument.annotation else ""
        if re.search(r"\b(float|ArrayLike|Band)\b", kind):
            yield argument.arg


def loose(text: str, node: Definition) -> Iterator[str]:
    """Constants of a law of which no formula of its docstring speaks.

    It does by the constant's name, or by a letter or an equation's number that
    the constant's entry gives: "safe: d_safe, m", "c1: of (10), 1/s".
    """
    told = entries(text, "Args") | entries(text, "Attributes")
    known = letters(text)
    for name in constants(node):
        meant = set(SYMBOL.findall(told.get(name, ""))) - ENGLISH
        if name not in known and not meant & known:
            yield name


def states_law(text: str) -> bool:
    """Whether a line of its own, or a span, holds the programme or the dynamics."""
    return any(RELATION.search(row) or "minimise" in row for row in spans(text))


def paper_equations(text: str) -> set[str]:
    """Numbers of the equations that a source names: "eqs. (3), (9)-(12)"."""
    runs = re.findall(r"\beqs?\. ((?:\(\d+\)(?:, |-| and )?)+)", text)
    return set(re.findall(r"\((\d+)\)", " ".join(runs)))


def has_source(text: str) -> bool:
    """A paper with its year, or "ours" and a reason; of the founding paper, where."""
    said = paragraph(text, "Source")
    reason = OWN.match(said) and len(said.split()) >= 6
    where = "Hannaford" not in said or PLACE.search(said)
    return bool((YEAR.search(said) or reason) and where)


def laws(house: House) -> Iterator[tuple[str, str, Definition]]:
    """Exported schemes and networks: (name, docstring, syntax tree)."""
    for room, module, name, node in exported(house):
        if room in CONTENT and not _frame(house, module, node):
            yield f"{module}.{name}", house.text(node), node


def _frame(house: House, module: str, node: Definition) -> bool:
    """Whether it is the common form of laws, and none itself."""
    if not isinstance(node, ast.ClassDef):
        return False
    line = lineage(house, module, node)
    named = {m.name for c in line for m in methods(c)}
    abstract = "ABC" in map(ast.unparse, node.bases)
    return abstract or not named & {"__call__", "derivative"}


def formulas(house: House) -> Iterator[tuple[Function, list[str]]]:
    """Functions that hand out an expression, with all that explains them:

    their own docstring, their class's and their module's.
    """
    for module in house.modules.values():
        if not any(f"{module.name}.".startswith(f"{place}.") for place in PLACES):
            continue
        above = ast.get_docstring(module.tree) or ""
        for function in house.functions(module):
            names = (function.owner, function.node.name)
            returns = function.node.returns
            private = any(n.startswith("_") and n != "__call__" for n in names)
            if (
                private
                or returns is None
                or not EXPRESSION.search(ast.unparse(returns))
            ):
                continue
            owner = module.classes.get(function.owner)
            around = house.text(owner) if owner is not None else ""
            yield function, [function.text, around, above]
