"""Arrays of the public interface state a shape, physical quantities a unit."""

import ast
import re

import pytest

from tests.docstrings import House, seen
from tests.quantities import exported, fields, lineage, numbers
from tests.syntax import entries

PHYSICAL = {
    f"rrnn_opt.{room}"
    for room in (
        *("robot", "scene", "motion", "planning", "simulation"),
        *("formulations", "networks"),
    )
}
"""Rooms whose numbers are of the world; elsewhere names of quantities tell."""


def shapeless(house):
    """Arrays of which nobody says how long they are."""
    return [str(n) for n in numbers(house) if n.is_array and not n.has_shape]


def unitless(house):
    """Numbers of the world without a unit, and without a word that there is none."""
    for n in numbers(house):
        physical = n.room in PHYSICAL or n.is_measured
        if physical and (n.is_array or n.is_float) and not n.has_unit:
            yield str(n)


def unexplained(house):
    """Fields that ``Attributes`` leaves out, and entries that are no fields."""
    for _, module, name, node in exported(house):
        if not hasattr(node, "bases"):
            continue
        line = list(lineage(house, module, node))
        told = [set(entries(house.text(c), "Attributes")) for c in line]
        own = fields(node)
        known = {f for c in line for f in fields(c)} | made(line)
        if own and any(told):
            missing = sorted(own.keys() - set().union(*told))
            yield from (f"{module}.{name}: {field}" for field in missing)
            yield from (f"{module}.{name}: {f}?" for f in sorted(told[0] - known))


def made(line):
    """What instances of a class get besides annotated fields: set in methods."""
    return {
        node.attr
        for owner in line
        for node in ast.walk(owner)
        if isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store)
    }


def test_arrays_state_their_shape(house):
    assert shapeless(house) == []


def test_quantities_state_their_unit(house):
    assert list(unitless(house)) == []


def test_attributes_are_the_fields(house):
    assert list(unexplained(house)) == []


def test_enough_is_looked_at(house):
    found = list(numbers(house))
    assert sum(n.is_array for n in found) > 150
    assert sum(n.is_float and n.room in PHYSICAL for n in found) > 150


SMALL = '''
from dataclasses import dataclass

__all__ = ["Motion", "reach"]

@dataclass
class Motion:
    """A motion.

    Attributes:
        q: positions, (n, nv), rad or m.
        duration: of the whole, s.
    """

    q: Array
    duration: float

    def at(self, time: float) -> Array:
        """Where it is, (nv,), rad.

        Args:
            time: since the start, s.
        """

def reach(q: Array, *, speed: float = 1.0, share: float = 0.5) -> float:
    """How far it gets.

    Args:
        q: start, (nv,), rad.
        speed: largest, rad/s.
        share: of the speed, a ratio.

    Returns:
        The way, rad.
    """
'''


def found_in(text):
    house = House({"rrnn_opt.motion": text})
    checks = (shapeless, unitless, unexplained)
    return {check for check in checks if list(check(house))}


@pytest.mark.parametrize(
    ("before", "after", "finds"),
    [
        ("", "", set()),
        (r"positions, \(n, nv\), rad", "positions, rad", {shapeless}),
        (r"positions, \(n, nv\)", "positions (of all, the joints)", {shapeless}),
        (r"\(n, nv\), rad or m\.", "(n, nv).", {unitless}),
        (r"\(n, nv\), rad or m\.", "(n, nv), radians and such.", {unitless}),
        ("of the whole, s", "of the whole", {unitless}),
        ("of the whole, s", "of the whole, as is usual", {unitless}),
        (r"it is, \(nv,\), rad", "it is", {shapeless, unitless}),
        (r"start, \(nv,\), rad", "start", {shapeless, unitless}),
        ("since the start, s", "since the start", {unitless}),
        ("largest, rad/s", "largest", {unitless}),
        ("largest, rad/s", "largest, share", set()),
        (", a ratio", "", {unitless}),
        ("The way, rad", "The way", {unitless}),
        ("        duration: of the whole, s.\n", "", {unitless, unexplained}),
        ("    duration: float\n", "", {unexplained}),
    ],
)
def test_a_dropped_word_is_found(before, after, finds):
    text = re.sub(before, lambda _: after, SMALL, count=1)
    assert found_in(text) == finds


@pytest.mark.parametrize(
    ("module", "line", "check"),
    [
        ("motion.path", "        waypoints: (N, nv), N >= 1, rad", shapeless),
        (
            "robot.tree",
            "        velocity: largest speed, (nv,), rad/s or m/s",
            unitless,
        ),
        ("simulation.task_parts", "        dt: control period, s.", unitless),
        ("scene.shapes", "        size: full edge lengths, (3,), m.", shapeless),
    ],
)
def test_a_dropped_line_is_found_in_the_package_itself(sources, module, line, check):
    as_it_is, without = seen(
        check, sources, f"rrnn_opt.{module}", line, "        x: such"
    )
    assert as_it_is == []
    assert without
