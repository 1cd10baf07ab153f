"""Parameter points at which schemes and networks are held to account.

A point is feasible by construction: a joint quantity u within the bounds is
drawn first, then the task is set to what u does.  Four kinds of points are
drawn on purpose: inside the limits, with active bounds, near singularities,
and with obstacles that act.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from rrnn_opt.errors import InfeasibleQpError
from rrnn_opt.formulation import Formulation
from rrnn_opt.robot import Kinematics
from rrnn_opt.solving import TIGHT
from rrnn_opt.solving.parts import Dense
from rrnn_opt.symbolic import Symbol
from rrnn_opt.validation.studies.postures import Array, Postures

KINDS = ("inside", "bounds", "singular", "contact")

TURN = tuple(int(c) for c in "10311023110131103110")
"""Kind of each point in turn, of twenty: 5, 9, 2 and 4."""

TASKS = ("rd_dot", "rd_ddot")
"""Parameters that are set to what the drawn u does."""

FAR = 100.0
"""A clearance at which no obstacle acts, m."""

ON_BOUND = 1e-9
_TRIES = 40


@dataclass(frozen=True, eq=False)
class Point:
    """Parameters of a scheme, and what the reference solver says of them.

    Attributes:
        kind: one of ``KINDS``.
        parameters: by name.
        problem: the QP.
        bound: whether a bound is active at the reference optimum.
        contact: whether an obstacle acts: without it the optimum is another.
    """

    kind: str
    parameters: Mapping[str, Array]
    problem: Any
    bound: bool
    contact: bool


class Points:
    """A seeded source of points for one scheme on one robot.

    Args:
        form: the scheme.
        kin: kinematics of the robot.
    """

    def __init__(self, form: Formulation, kin: Kinematics) -> None:
        self._form, self._kin = form, kin
        self._postures = Postures(kin)
        self._shapes = {s.name: s for s in form.parameters}
        symbols, qp = [p.sx for p in form.parameters], form.qp
        self._rows = ca.Function("rows", symbols, [qp.A, qp.b])
        self._tip = ca.Function("tip", [kin.q], [kin.position()])
        J = kin.jacobian()
        self._moving = np.array([not J[i, :].is_zero() for i in range(3)])

    @property
    def has_contacts(self) -> bool:
        """Whether obstacles enter the scheme."""
        return "clearances" in self._shapes

    def kind(self, index: int) -> str:
        """Kind of the point of that number; bounds where a scheme has no contacts."""
        kind = KINDS[TURN[index % len(TURN)]]
        return "bounds" if kind == "contact" and not self.has_contacts else kind

    def draw(self, kind: str, rng: np.random.Generator) -> Point | None:
        """A point of that kind, or the last feasible one; None if there was none.

        Args:
            kind: one of ``KINDS``.
            rng: where all randomness comes from.
        """
        last = None
        for _ in range(_TRIES):
            given = self._candidate(kind, rng)
            point = None if given is None else self._judged(kind, given)
            if point is None:
                continue
            last = point
            wanted = {"bounds": point.bound, "contact": point.contact}
            if wanted.get(kind, True) or (
                kind == "bounds" and not self._form.qp.bounded
            ):
                return point
        return last

    def _candidate(
        self, kind: str, rng: np.random.Generator
    ) -> dict[str, Array] | None:
        given = {name: _value(s, kind, rng) for name, s in self._shapes.items()}
        given |= self._of_robot(kind, rng, given)
        for task in TASKS:
            if task in given:
                given[task] = np.zeros(self._shapes[task].size)
        try:
            qp = Dense.of(self._form.qp.at(**given))
        except InfeasibleQpError:
            return None
        wanted = self._decision(qp, kind, rng)
        tasks = [task for task in TASKS if task in given]
        if tasks:
            self._meet(tasks[-1], given, wanted, step=1.0)
            if kind == "contact":
                self._meet("clearances", given, wanted, step=1e-3)
        return given

    def _of_robot(
        self, kind: str, rng: np.random.Generator, given: dict[str, Array]
    ) -> dict[str, Array]:
        """Values that are measured on the robot."""
        draws = {
            "bounds": self._postures.near_limits,
            "singular": self._postures.near_singularity,
        }
        q = draws.get(kind, self._postures.inside)(rng)
        made = {"q": q}
        if "rd" in given:
            tip = np.asarray(self._tip(q)).ravel()
            made["rd"] = tip + self._moving * given["rd"]
        if "q_start" in given:
            made["q_start"] = q + given["q_start"]
        if "qd" in given:
            made["qd"] = 0.2 * self._kin.robot.limits.velocity * given["qd"]
        if "normals" in given:
            normals = self._moving[:, None] * given["normals"].reshape(3, -1)
            made["normals"] = normals / np.linalg.norm(normals, axis=0)
        return made

    def _decision(self, qp: Dense, kind: str, rng: np.random.Generator) -> Array:
        """A decision within the bounds; the part beyond the joints is zero."""
        nv = self._kin.robot.nv
        speed = self._kin.robot.limits.velocity
        low, high = np.maximum(qp.lb[:nv], -speed), np.minimum(qp.ub[:nv], speed)
        high = np.maximum(low, high)
        u = np.clip(0.3 * rng.uniform(-1.0, 1.0, nv) * speed, low, high)
        if kind == "bounds":
            edge = np.where(rng.random(nv) < 0.5, low, high)
            u = np.where(rng.random(nv) < 0.6, edge, rng.uniform(low, high))
        whole = np.zeros(qp.q.size)
        whole[:nv] = u
        return whole

    def _meet(
        self, name: str, given: dict[str, Array], wanted: Array, *, step: float
    ) -> None:
        """Change a parameter so that A wanted = b, b being affine in it there."""
        A, b = self._equalities(given)
        left = A @ wanted - b
        if np.abs(left).max(initial=0.0) <= 1e-12:
            return
        size = self._shapes[name].size
        slope = np.zeros((left.size, size))
        for k in range(size):
            moved = {**given, name: given[name] + step * np.eye(size)[k]}
            slope[:, k] = (self._equalities(moved)[1] - b) / step
        given[name] = given[name] + np.linalg.lstsq(slope, left, rcond=None)[0]

    def _equalities(self, given: dict[str, Array]) -> tuple[Array, Array]:
        """A and b of the equality rows."""
        A, b = self._rows.call([given[name] for name in self._shapes])
        return np.asarray(A), np.asarray(b).ravel()

    def _judged(self, kind: str, given: dict[str, Array]) -> Point | None:
        """The point with what DAQP says; None where DAQP finds no optimum."""
        problem = self._form.qp.at(**given)
        x = _optimum(problem)
        if x is None:
            return None
        qp = Dense.of(problem)
        gap = np.minimum(x - qp.lb, qp.ub - x)
        contact = self.has_contacts and self._acts(given, x)
        return Point(kind, given, problem, bool((gap <= ON_BOUND).any()), contact)

    def _acts(self, given: dict[str, Array], x: Array) -> bool:
        far = {**given, "clearances": np.full_like(given["clearances"], FAR)}
        free = _optimum(self._form.qp.at(**far))
        return free is None or bool(np.abs(free - x).max() > 1e-6)


def _optimum(problem: Any) -> Array | None:
    """DAQP's answer, where it passes the check of its residuals."""
    import qpsolvers

    answer = qpsolvers.solve_problem(problem, solver="daqp", **TIGHT["daqp"])
    if not answer.found or not answer.is_optimal(1e-6):
        return None
    return np.asarray(answer.x, dtype=np.float64)


def _value(symbol: Symbol, kind: str, rng: np.random.Generator) -> Array:
    """A value by the name that schemes share; a small one for a name unknown."""
    shape = symbol.shape if symbol.shape[1] > 1 else (symbol.size,)
    normal = rng.normal(size=shape)
    scale = 10.0 ** rng.uniform(-4.0, -1.0 if kind == "bounds" else -2.0)
    near, far = (0.0, 0.08) if kind == "contact" else (0.05, 0.4)
    values = {
        "rd": scale * normal,
        "error": scale * normal,
        "e_int": 0.1 * scale * normal,
        "q_start": 0.3 * normal,
        "normals": normal,
        "clearances": rng.uniform(near, far, shape),
        "magnitudes": rng.uniform(0.0, 0.1, shape),
        "lam": 1e3 * scale * normal,
        "attraction": 0.1 * normal,
        "bounds": rng.uniform(0.0, 0.005, shape),
        "steering_margin": rng.uniform(0.0, 0.02, shape),
        "radius": rng.uniform(0.05, 0.3, shape),
    }
    return np.asarray(values.get(symbol.name, 0.05 * normal))
