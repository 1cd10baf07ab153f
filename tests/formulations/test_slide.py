"""A step on the edge of a contact row, taken for real, keeps its promised margin."""

import casadi as ca
import numpy as np
import pytest
from scipy.optimize import brentq

from rrnn_opt.formulations.slide import offset
from rrnn_opt.robot.motion_bound import motion_bound
from rrnn_opt.robot.reach import ancestor_mask, reach

MARGIN, CLEARANCE = 0.01, 0.06


def row_of(kin):
    """Centres; and bound B and right-hand side of the row, for sphere i and u."""
    robot, u = kin.robot, ca.SX.sym("u", kin.robot.nv)
    levers, masks = reach(robot), ancestor_mask(robot).astype(float)
    rights = [
        offset(
            ca.SX(CLEARANCE),
            ca.SX(MARGIN),
            motion_bound(robot.tree, u, ca.SX(levers[:, i]), ca.SX(masks[:, i])),
        )
        for i in range(len(robot.spheres))
    ]
    q = ca.SX.sym("q", robot.nv)
    centres = kin.functions()["sphere_centres"]
    moved = ca.jacobian(ca.vec(centres(q)), q)
    return (
        centres,
        ca.Function("jacobian", [q], [moved]),
        ca.Function("right", [u], [ca.vertcat(*rights)]),
    )


@pytest.mark.parametrize("name", ["planar3", "pa10"])
def test_a_step_on_the_edge_of_its_row_keeps_the_steering_margin(arms, name):
    """A half-space with normal n stands ``CLEARANCE`` from the sphere; n'J u is what
    the row allows at most, and the sphere goes to where pure kinematics put it."""
    kin, rng = arms[name], np.random.default_rng(4)
    centres, jacobian, right = row_of(kin)
    limits, left = kin.robot.limits, []
    for _ in range(200):
        q = rng.uniform(np.maximum(limits.lower, -3), np.minimum(limits.upper, 3))
        sphere = int(rng.integers(len(kin.robot.spheres)))
        rows = np.array(jacobian(q))[3 * sphere : 3 * sphere + 3]
        ahead = rng.normal(size=kin.robot.nv)
        speed = rows @ ahead
        if np.linalg.norm(speed) < 1e-3:
            continue
        n = -speed / np.linalg.norm(speed)

        def lack(s, ahead=ahead, way=n @ speed, sphere=sphere):
            return float(right(s * ahead)[sphere]) - s * way

        if lack(1.0) <= 0.0:  # it may go all the way
            continue
        u = brentq(lack, 0.0, 1.0, xtol=1e-15) * ahead
        went = np.array(centres(q + u) - centres(q))[:, sphere]
        left.append(CLEARANCE + n @ went - MARGIN)
    assert len(left) > 50
    assert min(left) >= -1e-12
    assert min(left) < 0.5 * (CLEARANCE - MARGIN)  # the row is not idle either
