"""How far a sphere can stray from its tangent, in SX.

For joint increments dq the centre p of a sphere moves along
``p(s) = p(0) + s J dq + rest`` with ``|rest| <= s^2 / 2 * B(dq)`` and

    B = sum_k rev |dq_k| R_k (|dq_k| + 2 sum_{j<k rev} |dq_j|)
        + sum_k pris 2 |dq_k| sum_{j<k rev} |dq_j|

over the joints k that move the sphere, j<k being revolute joints nearer to
the base and R_k an upper bound of the distance from joint k to the centre.
It bounds the second derivative term by term: for revolute j <= k it is
``a_j x (a_k x (p - o_k))``, for a prismatic k and a revolute j ``a_j x a_k``,
and zero for a prismatic j.
"""

from __future__ import annotations

import casadi as ca

from rrnn_opt.robot.tree import PRISMATIC, JointTree


def joint_increments(tree: JointTree, u: ca.SX) -> list[ca.SX]:
    """``dq_k = multiplier_k u_source(k)`` of each joint, nj scalars, rad or m."""
    return [float(tree.multiplier[k]) * u[int(tree.source[k])] for k in range(tree.nj)]


def motion_bound(tree: JointTree, u: ca.SX, reach: ca.SX, mask: ca.SX) -> ca.SX:
    """B of the module's docstring, ``|p(s) - p(0) - s J dq| <= s^2 / 2 B(dq)``, m.

    Args:
        tree: the joints.
        u: coordinate increments, (nv, 1), rad or m.
        reach: R, (nj, 1), m.
        mask: 1 for a joint that moves the sphere, else 0, (nj, 1).

    Returns:
        B, scalar, m.
    """
    total, turned = ca.SX(0), ca.SX(0)
    for k, dq in enumerate(joint_increments(tree, u)):
        step = mask[k] * ca.fabs(dq)
        if tree.types[k] == PRISMATIC:
            total += 2 * step * turned
        else:
            total += step * reach[k] * (step + 2 * turned)
            turned += step
    return total


def travel(tree: JointTree, u: ca.SX, reach: ca.SX, mask: ca.SX) -> ca.SX:
    """Upper bound of the way that the centre goes, ``sum_k |dq_k| R_k``, m.

    R_k is 1 for a prismatic joint.

    Args and shapes are those of :func:`motion_bound`; the result is in m.
    """
    total = ca.SX(0)
    for k, dq in enumerate(joint_increments(tree, u)):
        lever = ca.SX(1) if tree.types[k] == PRISMATIC else reach[k]
        total += mask[k] * ca.fabs(dq) * lever
    return total
