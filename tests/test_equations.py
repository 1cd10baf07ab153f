"""Docstrings of formulas write them down, and say where they are from."""

import inspect
import re

import pytest

from rrnn_opt import formulations
from tests.catalogue import Scheme, form
from tests.docstrings import House, seen
from tests.equations import (
    OWN,
    YEAR,
    formulas,
    has_equation,
    has_source,
    laws,
    loose,
    paper_equations,
    states_law,
)
from tests.syntax import paragraph


def lawless(house):
    """Schemes and networks whose docstring does not hold their law."""
    return [name for name, text, _ in laws(house) if not states_law(text)]


def sourceless(house):
    """Those that do not say whose they are, by year and, of the paper, place."""
    return [name for name, text, _ in laws(house) if not has_source(text)]


def unbound(house):
    """Constants that stand in no formula of the docstring."""
    return [f"{n}: {c}" for n, text, node in laws(house) for c in loose(text, node)]


def wordy(house):
    """Functions that hand out an expression which nobody writes down."""
    for function, texts in formulas(house):
        if not any(has_equation(text) for text in texts):
            yield function.name


def test_schemes_and_networks_write_down_their_law(house):
    assert lawless(house) == []


def test_schemes_and_networks_cite(house):
    assert sourceless(house) == []


def test_every_constant_stands_in_an_equation(house):
    assert unbound(house) == []


def test_what_hands_out_an_expression_writes_it_down(house):
    assert list(wordy(house)) == []


@pytest.mark.parametrize("name", formulations.__all__)
def test_a_scheme_cites_as_its_docstring_does(name):
    """``citation`` travels with the generated C; the docstring is what one reads."""
    cited = form("planar3", Scheme(name, "")).citation
    text = inspect.cleandoc(getattr(formulations, name).__doc__)
    source = paragraph(text, "Source")
    assert set(YEAR.findall(source)) <= set(YEAR.findall(cited))
    assert paper_equations(source) == paper_equations(cited)
    stands_in = re.search("stand-in|ours|after|in place of|ours", cited)
    assert "Hannaford" in source or "Hannaford" not in cited or OWN.search(source)
    assert (
        not stands_in
        or OWN.search(source)
        or "after" in source.lower()
        or ("in place of" in source)
    )


def test_enough_is_looked_at(house):
    assert len(list(laws(house))) > 30
    assert len(list(formulas(house))) > 70


SMALL = '''
__all__ = ["damped"]

def damped(kin: Kinematics, *, kappa: float = 1.0, safe: float = 0.1) -> Formulation:
    """Follow a target.

        minimise    1/2 u'u
        subject to  rd_dot + kappa e - J(q) u = 0
                    n'J u >= -(d - d_safe)

    Args:
        kin: of the robot.
        kappa: rate, 1/s.
        safe: d_safe, m.

    Source:
        Li, Li, Hannaford (IEEE TII 2019), eqs. (3), (10).
    """
'''


def found_in(text):
    house = House({"rrnn_opt.formulations": text})
    checks = (lawless, sourceless, unbound, wordy)
    return {check for check in checks if list(check(house))}


LAW = r"        minimise(.*\n)+?\n"
SOURCE = r"Li, Li, Hannaford \(IEEE TII 2019\), eqs\. \(3\), \(10\)\."


@pytest.mark.parametrize(
    ("before", "after", "finds"),
    [
        ("", "", set()),
        (LAW, "", {lawless, unbound, wordy}),
        (LAW, "        As the best of them do.\n\n", {lawless, unbound, wordy}),
        (r"kappa e - J", "e - J", {unbound}),
        (r" - d_safe\)", ")", {unbound}),
        ("safe: d_safe, m", "safe: distance, m", {unbound}),
        (SOURCE, "Li, Li, Hannaford (IEEE TII 2019).", {sourceless}),
        (SOURCE, "Well known in the field, and often used there.", {sourceless}),
        (SOURCE, "Ours.", {sourceless}),
        (SOURCE, "Ours: the row is the derivative of the clearance.", set()),
        (SOURCE, "Liegeois 1977.", set()),
        (r"    Source:\n", "", {sourceless}),
    ],
)
def test_a_dropped_line_is_found(before, after, finds):
    text, changed = re.subn(before, lambda _: after, SMALL, count=1)
    assert changed
    assert found_in(text) == finds


@pytest.mark.parametrize(
    ("module", "line", "check"),
    [
        ("formulations.closed_loop", "rd_dot + kappa e - J(q) u = 0", unbound),
        ("formulations.repetitive_motion", "gain (q - q_start)", unbound),
        ("formulations.slide", "    Source:\n", sourceless),
        ("networks.znn", "Networks 16(6), 2005, on", sourceless),
        ("networks.memory_cell", "    Source:\n", sourceless),
        ("robot.rotation", "``T = [R p; 0 1]``, ", wordy),
    ],
)
def test_a_dropped_line_is_found_in_the_package_itself(sources, module, line, check):
    as_it_is, without = seen(check, sources, f"rrnn_opt.{module}", line, "")
    assert as_it_is == []
    assert without
