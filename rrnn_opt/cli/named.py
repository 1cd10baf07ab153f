"""Names on the command line become robots and schemes; nowhere else do they."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from rrnn_opt.cli.output import UsageError


def robot(name: str) -> Any:
    """A built-in robot by name, or the robot of a URDF file.

    Raises:
        UsageError: it is neither.
        RobotError: the file cannot be used.
    """
    from rrnn_opt.robot import Robot
    from rrnn_opt.robot.builtin import BUILTIN

    if name in BUILTIN:
        return Robot.builtin(name)
    if Path(name).suffix.lower() in (".urdf", ".xml"):
        return Robot.from_urdf(name)
    raise UsageError(unknown("robot", name, BUILTIN))


def scheme(name: str) -> Any:
    """A scheme of ``rrnn_opt.formulations`` by name.

    Raises:
        UsageError: there is none of that name.
    """
    from rrnn_opt import formulations

    if name not in formulations.__all__:
        raise UsageError(unknown("formulation", name, formulations.__all__))
    return getattr(formulations, name)


def unknown(kind: str, name: str, known: Iterable[str]) -> str:
    """One sentence about a name that is not known, with the nearest that is."""
    names = list(known)
    close = difflib.get_close_matches(name, names, n=1)
    hint = f"did you mean '{close[0]}'?" if close else "known: " + ", ".join(names)
    return f"no {kind} is called '{name}'; {hint}"
