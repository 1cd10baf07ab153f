"""Arms that move in closed loop, and the schemes that they are asked to follow."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import casadi as ca
import numpy as np

from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations import clearance_rows, minimum_velocity
from rrnn_opt.robot import Kinematics, Robot
from rrnn_opt.solving.parts import Array

SAFE_M = 0.02
"""Clearance that the rows of obstacles keep."""

POSTURES: dict[str, tuple[float, ...]] = {
    "pa10": (0.0, 0.6, 0.0, 1.2, 0.0, 0.8, 0.0),
    "panda": (0.0, -0.3, 0.0, -2.0, 0.0, 1.8, 0.7),
    "raven2": (0.8, 1.6, 0.4, 0.1, 0.2, 0.1),
}
"""Bent postures, rad (insertion: m)."""

ARMS = (*POSTURES, "ur5")

UR5 = (0.2, -1.2, 1.6, -0.8, -1.2, 0.3)


@dataclass(frozen=True, eq=False)
class Arm:
    """A robot with what the loop asks of it.

    Attributes:
        kin: its kinematics.
        start: a bent posture, (nv,), rad or m.
        size: half the width of the curves it follows, m.
    """

    kin: Kinematics
    start: Array
    size: float

    @property
    def tip(self) -> ca.Function:
        """Function from q to the position of the tip, m."""
        return ca.Function("tip", [self.kin.q], [self.kin.position()])


@lru_cache(maxsize=8)
def arm(name: str) -> Arm:
    """An arm of ``ARMS``; "ur5" is read from a URDF.

    Raises:
        RrnnError: it is none of them, or its URDF is not installed.
    """
    if name in POSTURES:
        robot = Robot.builtin(name)
        size = 0.005 if name == "raven2" else 0.04
        return Arm(Kinematics(robot), np.array(POSTURES[name]), size)
    if name != "ur5":
        raise RrnnError(f"no arm '{name}' moves here; there are {', '.join(ARMS)}")
    return Arm(
        Kinematics(Robot.from_urdf(_ur5_urdf(), tip="tool0")), np.array(UR5), 0.04
    )


def _ur5_urdf() -> str:
    from importlib import metadata

    try:
        files = metadata.files("example-robot-data") or []
    except metadata.PackageNotFoundError:
        files = []
    found = [str(f.locate()) for f in files if f.name == "ur5_robot.urdf"]
    if not found:
        raise RrnnError("the URDF of the ur5 needs: pip install example-robot-data")
    return found[0]


def velocity_scheme(name: str) -> Formulation:
    """``minimum_velocity`` with the limits (10)."""
    return minimum_velocity(arm(name).kin)


def obstacle_scheme(name: str) -> Formulation:
    """``clearance_rows`` with three contacts of the spheres that move fastest."""
    return clearance_rows(arm(name).kin, contacts=contacts(name), safe=SAFE_M)


def contacts(name: str) -> list[int]:
    """Three spheres: the last one, and two further up the arm."""
    count = len(arm(name).kin.robot.spheres)
    return sorted({count - 1, (3 * count) // 4, count // 2})
