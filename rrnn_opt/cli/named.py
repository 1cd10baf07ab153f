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


def network(name: str) -> Any:
    """A network rule of ``rrnn_opt.networks`` by name, with its own settings.

    Raises:
        UsageError: there is none of that name.
    """
    import inspect

    from rrnn_opt import networks

    rules = {k: v for k, v in vars(networks).items() if k in networks.__all__}
    known = [
        k
        for k, v in rules.items()
        if inspect.isclass(v)
        and issubclass(v, networks.Network)
        and v is not networks.Network
    ]
    if name not in known:
        raise UsageError(unknown("network", name, sorted(known)))
    return rules[name]()


def unknown(kind: str, name: str, known: Iterable[str]) -> str:
    """One sentence about a name that is not known, with the nearest that is."""
    names = list(known)
    close = difflib.get_close_matches(name, names, n=1)
    hint = f"did you mean '{close[0]}'?" if close else "known: " + ", ".join(names)
    return f"no {kind} is called '{name}'; {hint}"
