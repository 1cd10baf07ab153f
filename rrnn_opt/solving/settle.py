"""Equilibria of networks, judged as optima of their programmes."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from rrnn_opt.arguments import checked
from rrnn_opt.dynamics import Dynamics
from rrnn_opt.errors import InfeasibleQpError, RrnnError, ShapeError
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks import LviPdnn
from rrnn_opt.networks.step_size import settling_step
from rrnn_opt.solving.network import RestableNetwork, restable
from rrnn_opt.solving.parts import Array, Dense
from rrnn_opt.solving.residual import NOT_JUDGED, Residual
from rrnn_opt.solving.rest import Attempt, Job
from rrnn_opt.solving.status import Status
from rrnn_opt.symbolic.values import arguments

MAX_STEPS = 200_000
"""Euler steps before a network counts as not settling; some 50 ms in C."""


@dataclass(frozen=True, eq=False)
class SettleInfo:
    """How a network came to rest.

    Attributes:
        status: our judgement; a point is returned only with ``has_point``.
        steps: Euler steps, or iterations of a map, in all.
        newton: Newton steps that finished it; 0 when the network alone did.
        step: the last Euler step used, s.
        residual: KKT residuals of the programme at the equilibrium, computed
            by us; infinite when nothing was reached.
        duals: "equality" is the lambda of (4), minus the y of qpsolvers;
            "inequality" its z; "box" its z_box.  All of the rows as declared.
        state: where the network stands, (n,); good for a warm start.
        time_s: wall time without compilation, s.
        message: one sentence.
    """

    status: Status
    steps: int
    newton: int
    step: float
    residual: Residual
    duals: Mapping[str, Array]
    state: Array
    time_s: float
    message: str = ""

    @property
    def kkt_residual(self) -> float:
        """The largest of the KKT residuals."""
        return self.residual.worst


@checked()
def settle(
    dyn: Dynamics | Formulation,
    *,
    tolerance: float = 1e-8,
    max_steps: int = MAX_STEPS,
    step: float | None = None,
    start: ArrayLike | None = None,
    newton: bool = True,
    **params: ArrayLike,
) -> tuple[Array | None, SettleInfo]:
    """Run a network to its equilibrium and judge it as the QP's optimum.

    The Euler loop runs in compiled C (through CasADi's interpreter where there
    is no compiler); a discrete network's loop is its own.  It stops on the
    network's own residual; then the KKT residual of the programme is computed,
    and the network runs on until that is within the tolerance too.  A network
    that is told the rates of its data (a ZNN) runs with data that stand still.

    Args:
        dyn: a network made from a formulation; or a formulation, which is
            settled by ``LviPdnn(whiten=True)``.  Whitened equality rows settle in
            far fewer steps; a rule that carries a paper's name has them only
            when asked to.
        tolerance: on the absolute KKT residual, largest component.
        max_steps: Euler steps in all for one choice of the step.
        step: Euler step h, s; None takes half of what is stable, from the
            modes of the network at its start (see ``settling_step``), and less
            if that diverges.  A map has no step.
        start: (n,) state to start from; by default the network's own
            beginning: multipliers zero, u the point of the box nearest to zero.
        newton: whether Newton steps on the network's own residual may finish
            what is slow: close to singular postures, and where active bounds
            leave few joints free, the network needs some
            1 / (h sigma_min^2 / eps) steps a digit.  The equilibrium is the
            same; ``info.newton`` tells.
        **params: one array a parameter of the formulation.

    Returns:
        The minimiser, (n,), or None where ``info.status`` has no point; and
        how it went.

    Raises:
        RrnnError: the network comes from no formulation; a parameter is missing,
            unknown, of the wrong shape or not finite; or the tolerance or the
            step is not positive.
        ShapeError: the start is not a state of the network.
    """
    return settle_at(
        default_network(dyn) if isinstance(dyn, Formulation) else dyn,
        params,
        tolerance=tolerance,
        max_steps=max_steps,
        step=step,
        start=start,
        newton=newton,
    )


def settle_at(
    dyn: Dynamics,
    parameters: Mapping[str, ArrayLike],
    *,
    tolerance: float = 1e-8,
    max_steps: int = MAX_STEPS,
    step: float | None = None,
    start: ArrayLike | None = None,
    newton: bool = True,
) -> tuple[Array | None, SettleInfo]:
    """``settle`` with the parameters in a mapping; they may have any name.

    Args:
        dyn: a network made from a formulation.
        parameters: one array a parameter of the formulation.
        tolerance: on the absolute KKT residual.
        max_steps: Euler steps in all for one choice of the step.
        step: Euler step h, s, or None.
        start: (n,) state to start from, or None.
        newton: whether Newton steps may finish it.

    Returns:
        As ``settle``.

    Raises:
        RrnnError: as ``settle``.
    """
    if not (tolerance > 0.0 and (step is None or step > 0.0)):
        raise RrnnError(
            f"settle: tolerance {tolerance}, step {step}: give positive ones"
        )
    form, dyn = _formulation(dyn), dyn.frozen
    values = arguments(dyn.parameters, parameters, "settle")
    try:
        problem = Dense.of(form.qp.at(**parameters))
    except InfeasibleQpError as error:
        return None, _refused(dyn, str(error))
    network = restable(dyn)
    begin = time.perf_counter()
    first = _start(network, values, start)
    h = settling_step(dyn, first, values) if step is None else step
    job = Job(network, problem, values, tolerance, max_steps, newton)
    best = job.insist(first, h)
    if start is not None and best.status is Status.MAX_ITER:
        best = job.insist(network.start(values), h)
    return best.x, _info(best, time.perf_counter() - begin)


@lru_cache(maxsize=32)
def default_network(form: Formulation) -> Dynamics:
    """The network that settles a formulation when none is given.

    It needs no definite Hessian and no feasible start, and its rows are whitened.
    """
    return LviPdnn(whiten=True)(form)


def _formulation(dyn: Dynamics) -> Formulation:
    if dyn.formulation is None:
        raise RrnnError(f"{dyn.name}: only a network made from a formulation settles")
    return dyn.formulation


def _start(
    network: RestableNetwork, values: Sequence[Array], start: ArrayLike | None
) -> Array:
    """The given state, or where the network begins by itself."""
    if start is None:
        return network.start(values)
    state = np.array(start, dtype=np.float64)
    if state.size != network.dynamics.state.size:
        raise ShapeError("start", (network.dynamics.state.size,), state.shape)
    return state.reshape(-1)


def _info(attempt: Attempt, time_s: float) -> SettleInfo:
    message = attempt.status.value
    if attempt.newton:
        message += f"; {attempt.newton} Newton steps finished it"
    return SettleInfo(
        status=attempt.status,
        steps=attempt.steps,
        newton=attempt.newton,
        step=attempt.step,
        residual=attempt.residual,
        duals=attempt.duals,
        state=attempt.state,
        time_s=time_s,
        message=message,
    )


def _refused(dyn: Dynamics, message: str) -> SettleInfo:
    """An empty bound: nothing was run."""
    nowhere = np.full(dyn.state.size, np.nan)
    return SettleInfo(
        Status.PRIMAL_INFEASIBLE, 0, 0, 0.0, NOT_JUDGED, {}, nowhere, 0.0, message
    )
