"""From a scheme, a robot and a task to a compiled loop; remembered."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Any, cast

from rrnn_opt import formulations
from rrnn_opt.dynamics import DiscreteDynamics, Dynamics, NeuralDynamics
from rrnn_opt.errors import ProblemError, RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.signs import Band
from rrnn_opt.networks import PrimalDual
from rrnn_opt.robot import Kinematics, Robot
from rrnn_opt.scene import Scene
from rrnn_opt.simulation.machine import Machine, machine
from rrnn_opt.simulation.obstacles import default_contacts
from rrnn_opt.simulation.signals import Surroundings
from rrnn_opt.simulation.task import Task

Scheme = Callable[..., Formulation]
Network = Callable[[Formulation], Dynamics]

NO_OBSTACLES = Scene()
"""One and the same for all tasks without obstacles, so that loops are found again."""


def prepared(
    scheme: str | Scheme, robot: Robot, task: Task, network: Network | None = None
) -> Machine:
    """The loop of a task, compiled or found compiled.

    Args:
        scheme: as in ``simulate``.
        robot: the robot.
        task: its frame, epsilon, scene and contacts enter.
        network: as in ``simulate``.

    Raises:
        ProblemError: there is no scheme, or no sphere, of that name.
        CompilerError: there is no C compiler.
        RrnnError: the loop has no signal for a parameter.
    """
    function = _named(scheme) if isinstance(scheme, str) else scheme
    scene = task.scene if len(task.scene) else NO_OBSTACLES
    key = (task.frame, task.control.epsilon, scene, task.contacts)
    return _machine(function, robot, *key, network)


def _named(name: str) -> Scheme:
    if name not in formulations.__all__:
        known = ", ".join(formulations.__all__)
        raise ProblemError("formulation", f"no scheme '{name}'; known: {known}")
    return cast(Scheme, getattr(formulations, name))


@lru_cache(maxsize=64)
def _machine(
    scheme: Scheme,
    robot: Robot,
    frame: str | None,
    epsilon: float,
    scene: Scene,
    contacts: tuple[int, ...] | None,
    network: Network | None,
) -> Machine:
    """Declare, make the network and compile; remembered for the last few."""
    kin, taken = Kinematics(robot), inspect.signature(scheme).parameters
    settings: dict[str, Any] = {"frame": frame, "epsilon": epsilon}
    form, chosen = _declared(scheme, kin, taken, settings, scene, contacts)
    band = taken["band"].default if "band" in taken else Band()
    around = Surroundings(scene, chosen, band.outer)
    rule = PrimalDual(epsilon=epsilon) if network is None else network
    made = rule(form)
    if not isinstance(made, NeuralDynamics | DiscreteDynamics):
        raise RrnnError(f"{made.name}: neither an ODE nor a map")
    return machine(made, kin, frame, around, epsilon=epsilon)


def _declared(
    scheme: Scheme,
    kin: Kinematics,
    taken: Mapping[str, inspect.Parameter],
    settings: dict[str, Any],
    scene: Scene,
    contacts: tuple[int, ...] | None,
) -> tuple[Formulation, tuple[int, ...]]:
    """The formulation, and the contacts it has: by default as many as it admits."""
    bound = getattr(scheme, "keywords", {})
    given = {k: v for k, v in settings.items() if k in taken and k not in bound}
    if "contacts" in bound:
        return scheme(kin, **given), tuple(bound["contacts"])
    if "contacts" not in taken:
        return scheme(kin, **given), ()
    if contacts is not None:
        return scheme(kin, contacts=contacts, **given), contacts
    wished = default_contacts(kin.robot) if len(scene) else ()
    for count in range(len(wished), 0, -1):
        chosen = wished[-count:]
        try:
            return scheme(kin, contacts=chosen, **given), chosen
        except RrnnError:
            if count == 1:
                raise
    return scheme(kin, **given), ()
