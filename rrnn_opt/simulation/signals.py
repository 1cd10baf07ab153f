"""What the loop tells a scheme, by the names of its parameters.

Everything is an expression in what the loop holds: positions q, velocities qd,
the reference and a small memory that is updated once a control period.

    rd, rd_dot, rd_ddot   of the curve; rd_dot plus kappa times the error
    error                 (6,) pose error, the orientation of the start kept
    e_int                 integral of the position error
    q_start               posture of the start
    normals, clearances   at the obstacle nearest to each contact's sphere
    magnitudes            stored as a contact enters the outer distance
    attraction, radius,   of the planner's step: towards the reference of the
    steering_margin,      next period
    bounds
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import casadi as ca
import numpy as np

from rrnn_opt.errors import RrnnError
from rrnn_opt.formulations.signs import Band, entry_magnitudes
from rrnn_opt.formulations.slide import tip_attraction
from rrnn_opt.robot import Kinematics
from rrnn_opt.robot.motion_bound import motion_bound
from rrnn_opt.robot.reach import reach
from rrnn_opt.scene import Scene
from rrnn_opt.simulation.obstacles import FAR, gaps
from rrnn_opt.symbolic import Symbol

RAW = ("q", "qd", "memory", "rd", "rd_dot", "rd_ddot", "settings")
"""Arguments of everything that is told; settings are dt and kappa."""

STEERING_MARGIN = 0.01
"""Steering margin of the planner's step, m."""


@dataclass(frozen=True, eq=False)
class Surroundings:
    """Obstacles and the spheres that are told of them.

    Attributes:
        scene: obstacles.
        contacts: index of the robot's sphere in each contact.
        outer: clearance at which magnitudes are stored, m.
    """

    scene: Scene = field(default_factory=Scene)
    contacts: tuple[int, ...] = ()
    outer: float = Band().outer


@dataclass
class _Memory:
    """Cells of memory: symbol, value at the start, value of the next period."""

    cells: list[tuple[ca.SX, ca.SX, ca.SX]] = field(default_factory=list)

    def keep(self, name: str, start: ca.SX) -> ca.SX:
        """A new cell; ``then`` says how it goes on."""
        symbol = ca.SX.sym(name, *start.shape)
        self.cells.append((symbol, start, symbol))
        return symbol

    def then(self, symbol: ca.SX, following: ca.SX) -> None:
        """The cell's value in the next period."""
        for k, (cell, start, _) in enumerate(self.cells):
            if cell is symbol:
                self.cells[k] = (cell, start, following)

    def column(self, part: int) -> ca.SX:
        """All symbols (0), starts (1) or next values (2) as one column."""
        return ca.vertcat(ca.SX(0, 1), *[ca.vec(cell[part]) for cell in self.cells])


class Signals:
    """Expressions of the parameters of one network.

    Args:
        kin: kinematics of the plant.
        frame: tracked frame; None for the tip.
        around: obstacles and contacts.

    Attributes:
        raw: symbols by the names of ``RAW``; memory after ``tell``.
        tip: position of the frame, (3, 1), m.
    """

    def __init__(
        self, kin: Kinematics, frame: str | None, around: Surroundings
    ) -> None:
        self._kin, self._frame, self._around = kin, frame, around
        nv = kin.robot.nv
        sizes = {"qd": nv, "rd": 3, "rd_dot": 3, "rd_ddot": 3, "settings": 2}
        self.raw = {"q": kin.q}
        self.raw |= {name: ca.SX.sym(name, size) for name, size in sizes.items()}
        self.tip = kin.position(frame)
        self._memory = _Memory()

    def tell(
        self, parameters: Sequence[Symbol], rates: Mapping[str, Symbol]
    ) -> list[ca.SX]:
        """Values of the parameters, in order.

            rd_dot -> rd_dot + kappa (rd - r(q)),   e_int -> e_int + dt (rd - r(q))

        and the rest as the module's docstring says; rates of parameters are
        their difference quotients.

        Args:
            parameters: of the network.
            rates: parameters that are rates of others, by the others' names.

        Raises:
            RrnnError: the loop has no such signal.
        """
        moving = {symbol.name: name for name, symbol in rates.items()}
        shapes = {p.name: p.shape for p in parameters}
        values: dict[str, ca.SX] = {}
        for name, shape in shapes.items():
            if name not in moving:
                values[name] = self._value(name, shape)
        for name, of in moving.items():
            values[name] = self._rate(of, values[of])
        self.raw["memory"] = self._memory.column(0)
        return [values[p.name] for p in parameters]

    @property
    def following(self) -> ca.SX:
        """Memory of the next period, a column: ``memory -> memory+``."""
        return self._memory.column(2)

    def start(self) -> ca.Function:
        """Posture to the memory of the first period."""
        return ca.Function("start", [self._kin.q], [self._memory.column(1)])

    def _value(self, name: str, shape: tuple[int, int]) -> ca.SX:
        plain = {"q", "qd", "rd", "rd_ddot"}
        if name in plain:
            return self.raw[name]
        if name in ("normals", "clearances", "magnitudes"):
            return self._contact(name)
        if name == "rd_dot":
            return self._rate_told(shape[0])
        made = {
            "e_int": self._integral,
            "q_start": lambda: self._memory.keep("q_start", self._kin.q),
            "error": self._pose_error,
            "attraction": self._attraction,
            "radius": self._radius,
            "steering_margin": lambda: ca.SX(STEERING_MARGIN),
            "bounds": self._bounds,
        }
        if name not in made:
            raise RrnnError(f"the loop has no signal for parameter '{name}'")
        return made[name]()

    @property
    def _error(self) -> ca.SX:
        return self.raw["rd"] - self.tip

    @property
    def _dt(self) -> ca.SX:
        return self.raw["settings"][0]

    def _rate_told(self, rows: int) -> ca.SX:
        """rd_dot + kappa e; a pose's angular part is kappa times its error."""
        kappa = self.raw["settings"][1]
        linear = self.raw["rd_dot"] + kappa * self._error
        if rows == 3:
            return linear
        return ca.vertcat(linear, kappa * self._pose_error()[3:])

    def _integral(self) -> ca.SX:
        total = self._memory.keep("e_int", ca.SX.zeros(3))
        self._memory.then(total, total + self._dt * self._error)
        return total

    def _pose_error(self) -> ca.SX:
        """Position error and the rotation vector from the frame to the start's."""
        turned = self._kin.pose(self._frame)[:3, :3]
        wanted = self._memory.keep("start_rotation", turned)
        columns = [ca.cross(turned[:, k], wanted[:, k]) for k in range(3)]
        half = (columns[0] + columns[1] + columns[2]) / 2
        sine = ca.sqrt(ca.dot(half, half))
        cosine = (ca.dot(turned, wanted) - 1) / 2
        small = sine < 1e-9
        angle = ca.if_else(
            small, 1, ca.atan2(sine, cosine) / ca.if_else(small, 1, sine)
        )
        return ca.vertcat(self._error, angle * half)

    def _gaps(self) -> tuple[ca.SX, ca.SX]:
        contacts, scene = self._around.contacts, self._around.scene
        if not contacts:
            return ca.SX(FAR), ca.SX([1.0, 0.0, 0.0])
        return gaps(self._kin, contacts, scene)

    def _contact(self, name: str) -> ca.SX:
        clearances, normals = self._gaps()
        if name == "clearances":
            return clearances
        if name == "normals":
            return normals
        entering = entry_magnitudes(self._kin, self._around.contacts)
        entry = entering(self.raw["q"], self.raw["qd"], normals)
        inside = clearances <= self._around.outer
        was = self._memory.keep("inside", ca.SX.zeros(*clearances.shape))
        stored = self._memory.keep("magnitudes", ca.SX.zeros(*entry.shape))
        values = [
            ca.if_else(inside[i], ca.if_else(was[i], stored[k], entry[k]), 0)
            for k, i in ((k, k // 3) for k in range(entry.size1()))
        ]
        told = ca.vertcat(*values)
        self._memory.then(was, inside)
        self._memory.then(stored, told)
        return told

    def _rate(self, name: str, value: ca.SX) -> ca.SX:
        """Backward difference; zero in the first period."""
        before = self._memory.keep(f"{name}_before", ca.SX.zeros(*value.shape))
        begun = self._memory.keep(f"{name}_begun", ca.SX.zeros(1))
        self._memory.then(before, value)
        self._memory.then(begun, ca.SX(1))
        return begun * (value - before) / self._dt

    def _radius(self) -> ca.SX:
        return self._dt * float(np.min(self._kin.robot.limits.velocity))

    def _attraction(self) -> ca.SX:
        ahead = self._error + self._dt * self.raw["rd_dot"]
        return tip_attraction(self._kin.jacobian(self._frame), ahead, self._radius())

    def _bounds(self) -> ca.SX:
        """Motion bounds at the attraction, of each contact's sphere."""
        robot, contacts = self._kin.robot, self._around.contacts
        if not contacts:
            return ca.SX(0)
        levers, w = reach(robot), self._attraction()
        values = []
        for k in contacts:
            moving = robot.tree.ancestors(robot.spheres[k].joint)
            mask = ca.SX([float(j in moving) for j in range(robot.tree.nj)])
            values.append(motion_bound(robot.tree, w, ca.SX(levers[:, k]), mask))
        return ca.vertcat(*values)
