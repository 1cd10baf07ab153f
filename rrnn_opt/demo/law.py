"""Stage 2: the law, written once, and what is taken from it."""

from __future__ import annotations

import time
from dataclasses import dataclass

import casadi as ca
import numpy as np

from rrnn_opt import emit
from rrnn_opt.demo.outcome import Check, at_most
from rrnn_opt.dynamics import NeuralDynamics
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations import minimum_velocity, position_feedback, slide
from rrnn_opt.lyapunov import LyapunovFunction
from rrnn_opt.networks import PrimalDual
from rrnn_opt.robot import Kinematics, Robot

EPSILON = 0.01


@dataclass(frozen=True, eq=False)
class Law:
    """Everything symbolic that the demo works with.

    Attributes:
        kinematics: of the arm.
        velocity: formulation (3) with the bounds (10).
        network: its projected network (6).
        feedback: the network that is exactly (17).
        contact: the planner's step with one obstacle row.
        program: V, V' and the kinematics, compiled.
        seconds: emission and compilation.
    """

    kinematics: Kinematics
    velocity: Formulation
    network: NeuralDynamics
    feedback: NeuralDynamics
    contact: Formulation
    program: emit.Program
    seconds: float


def write_law(robot: Robot) -> Law:
    """Kinematics, formulations, Lagrangian, networks and V of the arm."""
    begin = time.perf_counter()
    kin = Kinematics(robot)
    velocity = minimum_velocity(kin)
    feedback = PrimalDual(epsilon=EPSILON)(position_feedback(kin, epsilon=EPSILON))
    program = emit.compile(_functions(kin, feedback), name="demo_law")
    return Law(
        kinematics=kin,
        velocity=velocity,
        network=PrimalDual(epsilon=EPSILON)(velocity),
        feedback=feedback,
        contact=slide(kin, [len(robot.spheres) - 1]),
        program=program,
        seconds=time.perf_counter() - begin,
    )


def _functions(kin: Kinematics, feedback: NeuralDynamics) -> list[ca.Function]:
    """``kinematics``: tip and Jacobian; ``lyapunov``: V and V' along (17)."""
    q, rd = feedback.parameters
    error = rd.sx - kin.position()
    energy = LyapunovFunction(ca.dot(error, error) / 2, feedback.state, (q, rd))
    rate = energy.derivative(feedback, parameter_rates={"q": feedback.output})
    state = feedback.state
    return [
        ca.Function(
            "kinematics",
            [kin.q],
            [kin.position(), ca.densify(kin.jacobian())],
            ["q"],
            ["tip", "jacobian"],
        ),
        ca.Function(
            "lyapunov",
            [state.sx, q.sx, rd.sx],
            [energy.value, rate],
            [state.name, q.name, rd.name],
            ["V", "V_dot"],
        ),
    ]


def check_compiled(law: Law, rng: np.random.Generator) -> Check:
    """Largest difference between the compiled code and CasADi's interpreter."""
    functions = _functions(law.kinematics, law.feedback)
    worst = 0.0
    for function in functions:
        for _ in range(20):
            values = [
                rng.uniform(-1, 1, function.size1_in(i)) for i in range(function.n_in())
            ]
            ours = law.program.call(function.name(), *values)
            theirs = function.call(values)
            for a, b in zip(ours, theirs, strict=True):
                worst = max(worst, float(np.max(np.abs(a.ravel() - _column(b)))))
    return at_most("compiled C against CasADi's interpreter", worst, 1e-12)


def _column(value: ca.DM) -> np.ndarray:
    return np.array(value.full()).ravel()
