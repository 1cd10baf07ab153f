"""Every scheme and every network that the package exports, found by asking it."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from rrnn_opt import formulations, networks
from rrnn_opt.dynamics import Dynamics
from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.robot import Kinematics
from rrnn_opt.validation.studies.postures import Postures

Network = Callable[[Formulation], Dynamics]


@dataclass(frozen=True)
class Scheme:
    """A scheme with the static settings that the study gives it.

    Attributes:
        name: in tables, e.g. "minimum_velocity" or "minimum_velocity/pose".
        function: name in ``rrnn_opt.formulations``.
        options: keyword arguments besides the contacts.
        contacts: whether it takes contacts.
    """

    name: str
    function: str
    options: dict[str, Any] = field(default_factory=dict)
    contacts: bool = False

    def build(self, kin: Kinematics) -> Formulation:
        """The formulation for a robot, with as many contacts as it admits.

        Raises:
            RrnnError: no sphere of the robot can be in contact.
        """
        make: Callable[..., Formulation] = getattr(formulations, self.function)
        if not self.contacts:
            return make(kin, **self.options)
        spheres = contact_spheres(kin)
        for count in range(len(spheres), 0, -1):
            try:
                return make(kin, contacts=spheres[:count], **self.options)
            except RrnnError:
                if count == 1:
                    raise
        raise RrnnError(f"{kin.robot.name}: no sphere to be in contact")


def schemes() -> tuple[Scheme, ...]:
    """Every exported scheme, and its pose variant where it has one."""
    found = []
    for name in formulations.__all__:
        function = getattr(formulations, name)
        if not callable(function):
            continue
        signature = inspect.signature(function)
        if "Formulation" not in str(signature.return_annotation):
            continue
        contacts = "contacts" in signature.parameters
        found.append(Scheme(name, name, contacts=contacts))
        if "task" in signature.parameters:
            options = {"task": "pose"}
            found.append(Scheme(f"{name}/pose", name, options, contacts))
    return tuple(found)


def network_rules(*, whitened: bool = False) -> dict[str, Network]:
    """Every exported rule that makes a network of a formulation, as it comes.

    Args:
        whitened: also those that can whiten equality rows, doing so, with
            "/whiten" added to the name.
    """
    found: dict[str, Network] = {}
    for name in networks.__all__:
        rule: Any = getattr(networks, name)
        if not _is_rule(rule):
            continue
        found[name] = rule()
        if whitened and "whiten" in inspect.signature(rule).parameters:
            found[f"{name}/whiten"] = rule(whiten=True)
    return found


def _is_rule(member: Any) -> bool:
    """Whether it is a concrete class whose instances take a formulation."""
    concrete = inspect.isclass(member) and not inspect.isabstract(member)
    return concrete and "__call__" in dir(member)


def networks_of(
    form: Formulation, names: Sequence[str] = ()
) -> tuple[dict[str, Dynamics], dict[str, str]]:
    """Networks of a scheme by name, its data held still, and why others refuse.

    Args:
        form: the scheme.
        names: of ``network_rules(whitened=True)``; all plain ones by default.
    """
    rules = network_rules(whitened=True)
    made: dict[str, Dynamics] = {}
    refused: dict[str, str] = {}
    for name in names or network_rules():
        try:
            made[name] = rules[name](form).frozen
        except RrnnError as error:
            refused[name] = str(error)
    return made, refused


def contact_spheres(kin: Kinematics) -> list[int]:
    """Two spheres that move well: of all, and of those on the first half of the arm."""
    robot = kin.robot
    moved = np.array([len(robot.tree.ancestors(s.joint)) for s in robot.spheres])
    speed = _speeds(kin)
    near = moved <= moved.max() // 2 + 1
    return [int(np.argmax(speed)), int(np.argmax(np.where(near, speed, -1.0)))]


def _speeds(kin: Kinematics) -> NDArray[np.float64]:
    """Speed of each sphere when all joints turn, at a posture off the middle."""
    postures = Postures(kin)
    q = postures.lower + 0.6 * (postures.upper - postures.lower)
    centres, turning = kin.sphere_centres(), ca.SX.ones(kin.robot.nv, 1)
    velocity = ca.jtimes(ca.vec(centres), kin.q, turning)
    rates = np.asarray(ca.Function("v", [kin.q], [velocity])(q)).reshape(-1, 3)
    return np.asarray(np.linalg.norm(rates, axis=1), dtype=np.float64)
