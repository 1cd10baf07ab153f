"""Statements of the paper, one file each, as claims that can be settled.

A file says what is claimed, how the print is read, a variant whose truth is
known, and what is true instead.  It does not say what the verdict should be:
that is in ``expected.toml``, which is read when all is settled.

Source of all of them: Y. Li, S. Li, B. Hannaford, "A Model-Based Recurrent
Neural Network With Randomness for Efficient Control With Applications", IEEE
Trans. Industrial Informatics 15(4):2054-2063, 2019,
doi:10.1109/TII.2018.2869588.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib import import_module
from pathlib import Path

from rrnn_opt.robot import Kinematics
from rrnn_opt.verification import ClaimCase, Remark

__all__ = ["IDS", "case", "claims"]

Entry = ClaimCase | Remark


def _order(stem: str) -> tuple[int, str]:
    return int(stem[1:3]), stem[3:]


_STEMS = sorted(
    (p.stem for p in Path(__file__).parent.glob("c[0-9][0-9]*.py")), key=_order
)
IDS = {f"C{int(stem[1:3])}{stem[3:]}": stem for stem in _STEMS}
"""File by id, in the order of the paper; C21' is written C21p."""


def case(name: str, kinematics: Kinematics) -> Entry:
    """One statement.

    Args:
        name: one of :data:`IDS`.
        kinematics: of the robot, where the statement speaks of one.
    """
    module = import_module(f"{__name__}.{IDS[name]}")
    made: Callable[[Kinematics], Entry] = module.case
    return made(kinematics)


def claims(kinematics: Kinematics, names: Sequence[str] | None = None) -> list[Entry]:
    """Every statement, or those that are named.

    Args:
        kinematics: of the robot.
        names: ids; all by default.
    """
    return [case(name, kinematics) for name in (IDS if names is None else names)]
