"""Rows computed from spheres against clearances measured on the robot."""

import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.errors import RrnnError
from rrnn_opt.formulations.known_obstacles import row_bound, with_obstacles
from tests.formulations.points import centre, posture


def test_a_row_is_the_rate_of_its_clearance(pa10):
    last = len(pa10.robot.spheres) - 1
    wanted = {"points": [last // 2, last], "obstacles": 2}
    form = with_obstacles(rr.formulations.minimum_velocity(pa10), pa10, **wanted)
    rng = np.random.default_rng(1)
    q, u = posture(pa10, rng), rng.normal(size=pa10.robot.nv)
    obstacles = np.vstack([rng.uniform(-1.0, 1.0, (3, 2)), [[0.1, 0.2]]])

    def clearances(at):
        found = []
        for i in wanted["points"]:
            for k in range(2):
                gap = np.linalg.norm(centre(pa10, i, at) - obstacles[:3, k])
                found.append(gap - pa10.robot.spheres[i].radius - obstacles[3, k])
        return np.array(found)

    problem = form.qp.at(q=q, rd_dot=np.zeros(3), obstacles=obstacles)
    rate = (clearances(q + 1e-6 * u) - clearances(q - 1e-6 * u)) / 2e-6
    np.testing.assert_allclose(-problem.G @ u, rate, atol=1e-8)
    np.testing.assert_allclose(problem.h, 5.0 * (clearances(q) - 0.02), atol=1e-12)
    assert np.linalg.norm(problem.G, 2) <= row_bound(pa10, **wanted)


def test_what_cannot_be_is_said(pa10):
    form = rr.formulations.minimum_velocity(pa10)
    with pytest.raises(RrnnError, match="at least one"):
        with_obstacles(form, pa10, points=[], obstacles=1)
    with pytest.raises(RrnnError, match="no sphere"):
        with_obstacles(form, pa10, points=[999], obstacles=1)
    lifted = rr.formulations.minimum_acceleration(pa10)
    with pytest.raises(RrnnError, match="joint velocities"):
        with_obstacles(lifted, pa10, points=[0], obstacles=1)
