"""Schemes with an integrated multiplier: the integral becomes a network state."""

from __future__ import annotations

from dataclasses import replace

import casadi as ca

from rrnn_opt.dynamics import DiscreteDynamics, NeuralDynamics
from rrnn_opt.errors import RrnnError
from rrnn_opt.formulations.classical import multiplier_rate
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol

NAME = "lam"


def integrated(
    dynamics: NeuralDynamics | DiscreteDynamics,
    kin: Kinematics,
    frame: str | None,
    epsilon: float,
) -> NeuralDynamics | DiscreteDynamics:
    """The network with the integrator of its parameter ``lam`` inside, if it has one.

        epsilon lam' = rd_dot - J u,      lam(0) = 0                (6b), (15)

    u is what the network commands, not what the arm does: noise goes unseen.

    Args:
        dynamics: any network; without a parameter ``lam`` it is returned.
        kin: kinematics of the plant.
        frame: tracked frame; None for the tip.
        epsilon: time constant of the integrator, s.

    Raises:
        RrnnError: the network is no ODE.
    """
    found = [p for p in dynamics.parameters if p.name == NAME]
    if not found:
        return dynamics
    if not isinstance(dynamics, NeuralDynamics):
        raise RrnnError(f"{dynamics.name}: an integrated multiplier needs an ODE")
    lam, rest = found[0], [p for p in dynamics.parameters if p.name != NAME]
    wanted = Symbol.vector("rd_dot", 3, "m/s", "desired velocity of the frame")
    u = dynamics.output[: kin.robot.nv]
    rate = multiplier_rate(kin.jacobian(frame), u, wanted.sx, epsilon)
    state = ca.vertcat(dynamics.state.sx, lam.sx)
    return replace(
        dynamics,
        state=Symbol("state", state, dynamics.state.unit, "network state, then lam"),
        parameters=(*rest, wanted),
        derivative=ca.vertcat(dynamics.derivative, rate),
        residual=ca.vertcat(dynamics.residual, epsilon * rate),
        start=ca.vertcat(dynamics.start, ca.SX.zeros(3)),
    )
