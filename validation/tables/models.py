"""The seven models of Table I, as we have them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import casadi as ca
import numpy as np

from rrnn_opt.dynamics import NeuralDynamics
from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations import (
    joint_sign_sets,
    method1,
    method2,
    method3,
    model35,
    model36,
    model43,
)
from rrnn_opt.networks import DualNetwork, LviPdnn, Network, PrimalDual
from rrnn_opt.robot import Kinematics

Scheme = Callable[..., Formulation]


@dataclass(frozen=True)
class Model:
    """A row of Table I.

    Attributes:
        row: as the paper names it.
        scheme: ours in its place.
        network: the one it is known with; never whitened.
        law: "literal" where the network itself is what is proposed.
        planner: of ``rrnn_opt.planning``, where the row has one.
        standing: what ours is to the published model.
    """

    row: str
    scheme: Scheme
    network: Network
    law: str = "reduced"
    planner: str = ""
    standing: str = "a stand-in"

    def form(self, kin: Kinematics, contacts: tuple[int, ...] = ()) -> Formulation:
        """The scheme for a robot, with contacts if it can have any."""
        return self.told(contacts)(kin)

    def told(self, contacts: tuple[int, ...]) -> Scheme:
        """The scheme with contacts, if it can have any."""
        return partial(self.scheme, contacts=contacts) if self.avoids else self.scheme

    @property
    def avoids(self) -> bool:
        """Whether the scheme has anything for obstacles."""
        import inspect

        return "contacts" in inspect.signature(self.scheme).parameters


MODELS: tuple[Model, ...] = (
    Model("Model in [43]", model43, PrimalDual()),
    Model("Model in [44]", method3, PrimalDual()),
    Model("Model in [36]", model36, PrimalDual()),
    Model("Model in [35]", model35, PrimalDual()),
    Model(
        "Model in [25]",
        method1,
        DualNetwork(),
        planner="method1",
        standing="a reconstruction",
    ),
    Model(
        "Model in [26]",
        method2,
        LviPdnn(),
        planner="method2",
        standing="a reconstruction",
    ),
    Model(
        "Proposed",
        joint_sign_sets,
        PrimalDual(),
        law="literal",
        planner="paper",
        standing="(17) within (10) and (12) as printed, (12) read by transposed J",
    ),
)


@dataclass(frozen=True)
class FromAnywhere:
    """A network that begins in a random state.

    Attributes:
        network: the rule.
        seed: of the state; standard normal numbers.
    """

    network: Network
    seed: int

    def __call__(self, form: Formulation) -> NeuralDynamics:
        """The network of ``form``.

        Raises:
            RrnnError: the network is a map.
        """
        made = self.network(form)
        if not isinstance(made, NeuralDynamics):
            raise RrnnError(f"{made.name}: a map is not begun in a random state")
        rng = np.random.default_rng([self.seed, 1])
        start = ca.SX(ca.DM(rng.standard_normal(made.state.size)))
        return replace(made, start=start)
