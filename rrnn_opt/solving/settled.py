"""A settled network as a solver among solvers."""

from __future__ import annotations

from dataclasses import dataclass, field

from rrnn_opt.arguments import checked
from rrnn_opt.dynamics import Dynamics
from rrnn_opt.solving.dense_session import require_mode, require_setup
from rrnn_opt.solving.network import restable
from rrnn_opt.solving.parts import Array, Duals
from rrnn_opt.solving.protocol import Instance, Solution
from rrnn_opt.solving.settle import SettleInfo, settle_at


@checked()
@dataclass
class SettledNetwork:
    """The equilibrium of a network, instance by instance.

    Attributes:
        dynamics: made from the formulation that the instances come from.
        mode: "warm" starts where the last instance settled, "cold" at zero.
        tolerance: on the KKT residual.
        name: in tables.

    Raises:
        ArgumentError: there is no such mode.
    """

    dynamics: Dynamics
    mode: str = "warm"
    tolerance: float = 1e-10
    name: str = "network"
    _instance: Instance | None = field(default=None, init=False, repr=False)
    _state: Array | None = field(default=None, init=False, repr=False)

    def __post_init__(self) -> None:
        """Refuse an unknown mode."""
        require_mode(self.mode, "warm", "cold")

    def setup(self, instance: Instance) -> None:
        """Compile the network's loop (or find it compiled)."""
        restable(self.dynamics.frozen)
        self._instance, self._state = instance, None

    def update(self, instance: Instance) -> None:
        """Take the next parameter values."""
        self._instance = instance

    def solve(self) -> Solution:
        """Settle; see ``settle``.

        Raises:
            RrnnError: ``setup`` was not called.
        """
        instance = require_setup(self._instance)
        x, info = settle_at(
            self.dynamics,
            instance.parameters,
            tolerance=self.tolerance,
            start=self._state,
        )
        warm = self.mode == "warm" and info.status.has_point
        self._state = info.state if warm else None
        return Solution(
            x=x,
            duals=_duals(info) if x is not None else None,
            status=info.status,
            residual=info.residual,
            time_s=info.time_s,
            message=info.message,
        )


def _duals(info: SettleInfo) -> Duals:
    """The multipliers in qpsolvers' signs."""
    duals = info.duals
    return Duals(-duals["equality"], duals["inequality"], duals["box"])
