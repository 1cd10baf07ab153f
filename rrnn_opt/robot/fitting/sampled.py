"""Random postures of a robot, and where its links are in them."""

from __future__ import annotations

from collections.abc import Iterable

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from rrnn_opt.robot.kinematics import Kinematics
from rrnn_opt.robot.robot import Robot
from rrnn_opt.robot.tree import Array


class Sampled:
    """A robot in random postures between its limits, +-pi where there is none.

    Args:
        robot: the robot.
        links: whose poses are wanted.
        count: postures.
        seed: of the postures.
    """

    def __init__(
        self, robot: Robot, links: Iterable[str], count: int, seed: int
    ) -> None:
        low = np.where(np.isfinite(robot.limits.lower), robot.limits.lower, -np.pi)
        high = np.where(np.isfinite(robot.limits.upper), robot.limits.upper, np.pi)
        rng = np.random.default_rng(seed)
        self.robot, self.count = robot, count
        self.q: Array = rng.uniform(low, high, (count, robot.nv))
        kin = Kinematics(robot)
        self.poses: dict[str, Array] = {}
        for link in links:
            one = ca.Function("pose", [kin.q], [ca.densify(kin.pose(link))])
            stacked = np.array(one.map(count)(self.q.T))
            self.poses[link] = stacked.reshape(4, count, 4).transpose(1, 0, 2)

    def points(self, link: str, points: Array, where: NDArray[np.int64]) -> Array:
        """Points (n, 3) of a link's frame in the base, in some postures (k,); m.

        Returns:
            (k, n, 3).
        """
        pose = self.poses[link][where]
        turned = np.einsum("kij,nj->kni", pose[:, :3, :3], points)
        return np.asarray(turned + pose[:, None, :3, 3])
