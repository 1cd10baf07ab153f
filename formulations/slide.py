"""The planner's step: go where the attraction pulls, slide along obstacles.

    minimise    1/2 u'u - w'u
    subject to  n_i' J_i(q) u >= -max(d_i - m, 0) + B_i / 2     for contact i
                max(q- - q, -r) <= u <= min(q+ - q, r)

u is the joint increment of one step, w the attraction (towards a random
posture, a node or the goal), which is the linear term c = -w of the paper's
QP (3a).  Contact i is a sphere of the robot at gap d_i from an obstacle with
outward normal n_i; J_i is its Jacobian, m a steering margin and B_i the bound
of ``robot.motion_bound`` at u = w.  Obstacles are convex, hence

    gap(s) >= d_i + s n_i' J_i u - s^2 / 2 B_i(u),     0 <= s <= 1,

which is concave in s: d_i + n_i' J_i u - B_i(u)/2 > 0 proves the whole step.
That is the row itself, evaluated at B(u); nothing proved relies on how well
the QP was solved.

Source: Li, Li, Hannaford (IEEE TII 2019), eqs. (3), (10)-(13).  Where we
differ: linear rows take the place of the joint-wise sign sets (12), which do
not keep a point from its obstacle (for a planar arm at q = (90 deg, 0) the
set (12) admits the velocity (1, 0), which moves the tip along -x, into an
obstacle that it should leave along +x); the random attraction (13) is drawn
in joint space, since a point of the task space does not fix a posture.
"""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.robot import Kinematics
from rrnn_opt.robot.tree import PRISMATIC, JointTree
from rrnn_opt.symbolic import Symbol
from rrnn_opt.symbolic.linear import cholesky_solve


def row(
    tree: JointTree, axes: ca.SX, origins: ca.SX, mask: ca.SX, point: ca.SX, n: ca.SX
) -> ca.SX:
    """Template of a contact row: ``n'J`` of a point, one entry a coordinate.

        revolute:  (n'J)_k = z_k . ((p - o_k) x n),    prismatic:  z_k . n

    Args:
        tree: the joints.
        axes: world axes of the joints, (3, nj).
        origins: world origins of the joints, (3, nj), m.
        mask: 1 for a joint that moves the point, else 0, (nj, 1).
        point: (3, 1), m.
        n: unit normal, (3, 1).

    Returns:
        (1, nv), m/rad or 1.
    """
    entries = [ca.SX(0) for _ in range(1 + int(max(tree.source, default=-1)))]
    for k in range(tree.nj):
        axis = axes[:, k]
        if tree.types[k] == PRISMATIC:
            lever = ca.dot(n, axis)
        else:
            lever = ca.dot(axis, ca.cross(point - origins[:, k], n))
        entries[int(tree.source[k])] += float(tree.multiplier[k]) * mask[k] * lever
    return ca.horzcat(*entries)


def offset(clearance: ca.SX, steering_margin: ca.SX, bound: ca.SX) -> ca.SX:
    """Right-hand side of a contact row: -max(d - m, 0) + B/2, m.

    Inside the steering margin the row only forbids coming nearer; it never
    asks for a retreat, so u = 0 stays feasible up to the term B/2.
    """
    return -ca.fmax(clearance - steering_margin, 0) + bound / 2


def step_box(
    q: ca.SX, lower: ca.SX, upper: ca.SX, radius: ca.SX
) -> tuple[ca.SX, ca.SX]:
    """``max(q- - q, -r)`` and ``min(q+ - q, r)``, two (nv, 1), rad or m.

    Args:
        q: joint positions, (nv, 1), rad or m.
        lower: q-, (nv, 1), rad or m.
        upper: q+, (nv, 1), rad or m.
        radius: r, largest increment of a coordinate, scalar, rad or m.
    """
    return ca.fmax(lower - q, -radius), ca.fmin(upper - q, radius)


def joint_attraction(q: ca.SX, target: ca.SX, length: ca.SX) -> ca.SX:
    """Attraction w = target - q, cut at the norm ``length`` (rad); (nv, 1)."""
    difference = target - q
    norm = ca.sqrt(ca.dot(difference, difference))
    return difference * ca.fmin(1, length / ca.fmax(norm, 1e-30))


def tip_attraction(
    jacobian: ca.SX, error: ca.SX, length: ca.SX, damping: float = 1e-3
) -> ca.SX:
    """Attraction w = J' (J J' + damping I)^-1 e, cut at the norm ``length`` (rad).

    Args:
        jacobian: of the task, (m, nv).
        error: of the task, (m, 1), m and rad.
        length: largest norm of w, scalar.
        damping: m^2 or rad^2; keeps w bounded at singular postures.

    Returns:
        (nv, 1).
    """
    m = jacobian.size1()
    gram = jacobian @ jacobian.T + damping * ca.SX.eye(m)
    w = jacobian.T @ cholesky_solve(gram, error)
    norm = ca.sqrt(ca.dot(w, w))
    return w * ca.fmin(1, length / ca.fmax(norm, 1e-30))


def require_spheres(kin: Kinematics, spheres: Sequence[int]) -> None:
    """Refuse contacts with spheres that the robot has not.

    Args:
        kin: kinematics of the robot.
        spheres: index of the robot's sphere in each contact.

    Raises:
        RrnnError: there is no such sphere.
    """
    have = len(kin.robot.spheres)
    for index in spheres:
        if not 0 <= index < have:
            raise RrnnError(f"contacts: no sphere {index}; {kin.robot.name} has {have}")


@checked()
def slide(kin: Kinematics, contacts: Sequence[int] = ()) -> Formulation:
    """The planner's step: go where the attraction pulls, slide along obstacles.

        minimise    1/2 u'u - w'u
        subject to  n_i'J_i(q) u >= -max(d_i - m, 0) + B_i / 2     for contact i
                    max(q- - q, -r) <= u <= min(q+ - q, r)

    u is the joint increment of one step and w the attraction.  With B_i at the
    optimum, d_i + n_i'J_i u - B_i(u) / 2 > 0 proves the whole step free of
    contact i, because the gap along it is bounded by a concave function.

    Args:
        kin: kinematics of the robot.
        contacts: index of the robot's sphere in each contact; a sphere may
            stand in several.

    Returns:
        Formulation in the increment ``u`` (nv,), with parameters ``q`` (nv,),
        ``attraction`` w (nv,), ``normals`` (3, k), ``clearances`` d (k,),
        ``bounds`` B (k,), ``steering_margin`` m (1,) and ``radius`` r (1,).

    Raises:
        RrnnError: there is no such sphere.

    Source:
        Li, Li, Hannaford (IEEE TII 2019), eqs. (3), (10)-(13), with linear rows
        in place of the sets (12), which do not keep a point from its obstacle.
        The concave bound of the gap is ours.
    """
    require_spheres(kin, contacts)
    robot, k = kin.robot, max(len(contacts), 1)
    u = Symbol.vector("u", robot.nv, "rad", "joint increment of the step")
    w = Symbol.vector("attraction", robot.nv, "rad", "where the step is drawn to")
    q = Symbol("q", kin.q, "rad", "joint positions")
    normals = Symbol.matrix("normals", (3, k), "1", "outward normals of the obstacles")
    gaps = Symbol.vector("clearances", k, "m", "gaps between spheres and obstacles")
    bounds = Symbol.vector("bounds", k, "m", "motion bounds B at u = w")
    kept = "clearance kept where there is room"
    steering_margin = Symbol.vector("steering_margin", 1, "m", kept)
    radius = Symbol.vector("radius", 1, "rad", "largest increment of a joint")
    lower, upper = step_box(
        kin.q, ca.SX(robot.limits.lower), ca.SX(robot.limits.upper), radius.sx
    )
    return Formulation(
        name="slide",
        decision=u,
        parameters=(q, w, normals, gaps, bounds, steering_margin, radius),
        cost=ca.dot(u.sx, u.sx) / 2 - ca.dot(w.sx, u.sx),
        inequalities=_rows(kin, contacts, u, normals, gaps, bounds, steering_margin),
        lower=lower,
        upper=upper,
        citation="Li, Li, Hannaford, IEEE TII 15(4) 2019, eqs. (3), (10)-(13)",
        level="increment",
    )


def _rows(
    kin: Kinematics,
    contacts: Sequence[int],
    u: Symbol,
    normals: Symbol,
    gaps: Symbol,
    bounds: Symbol,
    steering_margin: Symbol,
) -> ca.SX:
    """Contact rows as ``offset - n'J u <= 0``, (k, 1)."""
    robot = kin.robot
    axes, origins, centres = kin.axes(), kin.origins(), kin.sphere_centres()
    rows = []
    for i, sphere in enumerate(contacts):
        moving = robot.tree.ancestors(robot.spheres[sphere].joint)
        mask = ca.SX([float(j in moving) for j in range(robot.tree.nj)])
        centre, n = centres[:, sphere], normals.sx[:, i]
        gradient = row(robot.tree, axes, origins, mask, centre, n)
        rows.append(
            offset(gaps.sx[i], steering_margin.sx, bounds.sx[i]) - gradient @ u.sx
        )
    return ca.vertcat(*rows) if rows else ca.SX(0, 1)
