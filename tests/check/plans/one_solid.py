"""One obstacle, asked point by point in world axes, rows being points."""

import numpy as np

from rrnn_opt.check.plans.solids.distance import Solids
from rrnn_opt.check.plans.solids.obstacle import read_obstacle


class OneSolid:
    """An entry of "obstacles" alone.

    Args:
        entry: as a problem states it.
    """

    def __init__(self, entry):
        self.obstacle = read_obstacle(entry, "o")
        self.solids = Solids.of([self.obstacle])

    def distance(self, points):
        return self.solids.distance(points.T, np.zeros(len(points), dtype=np.int64))

    def normals(self, points):
        _, n = self.solids.facing(points.T, np.zeros(len(points), dtype=np.int64))
        return n.T

    def gap(self, points, n):
        which = np.zeros(len(points), dtype=np.int64)
        local = self.solids.local(points.T, which)
        return self.solids.gap(local, self.obstacle.rotation.T @ n.T, which)
