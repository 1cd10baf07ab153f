"""Programmes without a solution: who says so, and who hands out a number.

The task velocity of ``minimum_velocity`` is put beyond what the box (10) can
do: along a random direction d the box reaches at most s = max d'J u, and
rd_dot = 1.5 s d + something across.  So y = d is a Farkas certificate by
construction, and nobody's word is needed for the truth.
"""

from __future__ import annotations

import warnings
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from rrnn_opt.dynamics import Dynamics
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations import minimum_velocity
from rrnn_opt.robot import Kinematics, Robot
from rrnn_opt.solving import TIGHT, Instance, Qpsolvers
from rrnn_opt.solving.parts import Dense, handed
from rrnn_opt.solving.settle import settle_at
from rrnn_opt.study import Case
from rrnn_opt.validation.studies.catalogue import networks_of
from rrnn_opt.validation.studies.postures import Array, Postures

SOLVERS = ("osqp", "daqp", "proxqp", "piqp")
BEYOND = 1.5
"""How far beyond the reach of the box, as a factor."""


@dataclass(frozen=True)
class Infeasible:
    """The study; one case a robot.

    Attributes:
        robots: built-in robots.
        points: programmes of each.
        networks: as in ``GroundTruth``.
    """

    robots: tuple[str, ...]
    points: int = 100
    networks: tuple[str, ...] = ()
    name: str = "infeasible"

    def __iter__(self) -> Iterator[Case]:
        """One case a robot."""
        for robot in self.robots:
            given = {"robot": robot, "count": self.points}
            given |= {"networks": list(self.networks)}
            yield Case(f"infeasible/{robot}", given)

    def measure(self, case: Case, rng: np.random.Generator) -> Mapping[str, Any]:
        """For each solver and network, what it said how often."""
        kin = Kinematics(Robot.builtin(case.parameters["robot"]))
        form = minimum_velocity(kin)
        made, _ = networks_of(form, self.networks)
        said = {name: Counter[str]() for name in (*SOLVERS, *made)}
        for _ in range(case.parameters["count"]):
            given = beyond_reach(form, kin, rng)
            for name in SOLVERS:
                said[name].update(_solver_says(name, form.qp.at(**given)))
            for name, network in made.items():
                said[name].update(_network_says(network, given))
        return {
            "robot": case.parameters["robot"],
            "infeasible": {name: dict(counts) for name, counts in said.items()},
        }


def beyond_reach(
    form: Formulation, kin: Kinematics, rng: np.random.Generator
) -> dict[str, Array]:
    """Parameters of ``minimum_velocity`` for which no velocity in the box will do.

    Args:
        form: the scheme.
        kin: kinematics of the robot.
        rng: where all randomness comes from.
    """
    q = Postures(kin).inside(rng)
    qp = Dense.of(form.qp.at(q=q, rd_dot=np.zeros(3)))
    moving = np.any(qp.A != 0.0, axis=1)
    d, across = moving * rng.normal(size=3), moving * rng.normal(size=3)
    d = d / np.linalg.norm(d)
    pull = qp.A.T @ d
    reach = float(np.where(pull > 0.0, qp.ub, qp.lb) @ pull)
    across = 0.1 * (across - (across @ d) * d)
    return {"q": q, "rd_dot": BEYOND * reach * d + across}


def _solver_says(name: str, problem: Any) -> list[str]:
    """Its own word, the kind of point that it hands out, and our judgement."""
    import qpsolvers

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            raw = qpsolvers.solve_problem(problem, solver=name, **TIGHT[name])
    except Exception as error:
        said = [f"raised {type(error).__name__}"]
    else:
        said = ["found" if raw.found else "not found", f"x {handed(raw.x)}"]
    solver = Qpsolvers(name)
    solver.setup(Instance(problem))
    return [*said, f"judged {solver.solve().status.key}"]


def _network_says(network: Dynamics, given: Mapping[str, Array]) -> list[str]:
    x, info = settle_at(network, given, max_steps=20_000)
    word = "not found" if x is None else "found"
    return [word, f"x {handed(x)}", f"judged {info.status.key}"]
