"""Constants of a robot as C tables: radii, reaches, masks, self pairs."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.robot.bound import ancestor_mask, reach
from rrnn_opt.robot.robot import BASE, PRISMATIC, Robot

Array = NDArray[np.float64]


def _c_table(kind: str, name: str, values: Iterable[float]) -> str:
    """``static const kind name[] = {...};`` with at least one entry."""
    if kind == "double":
        entries = [float(v).hex() for v in values] or ["0.0"]
    else:
        entries = [str(int(v)) for v in values] or ["0"]
    lines = [", ".join(entries[i : i + 6]) for i in range(0, len(entries), 6)]
    body = ",\n    ".join(lines)
    return f"static const {kind} {name}[{len(entries)}] = {{\n    {body}}};\n"


def levers(robot: Robot, reaches: Array, mask: Array) -> Array:
    """Norm of the gradient of the way: way <= |u| * lever, a sphere each, m/rad.

    Args:
        robot: the robot.
        reaches: (nj, ns), m.
        mask: joints that count, (nj, ns).
    """
    turning = np.array([t != PRISMATIC for t in robot.tree.types])[:, None]
    rates = np.where(turning, reaches, 1.0) * mask
    rates = rates * np.abs(robot.tree.multiplier)[:, None]
    summed = np.zeros((robot.nv, rates.shape[1]))
    np.add.at(summed, robot.tree.source, rates)
    return np.asarray(np.linalg.norm(summed, axis=0))


def _pair_groups(
    robot: Robot,
) -> tuple[list[tuple[int, int]], list[int], list[tuple[Array, Array]]]:
    """Sphere pairs sorted by group, the group of each, each group's joint masks.

    A group holds the pairs of two joints' bodies.
    """
    tree = robot.tree
    pairs = robot.sphere_pairs()
    index: dict[tuple[int, int], int] = {}
    masks: list[tuple[Array, Array]] = []
    groups: list[int] = []
    for i, j in pairs:
        key = (robot.spheres[i].joint, robot.spheres[j].joint)
        if key not in index:
            shared = set(tree.ancestors(tree.common_ancestor(*key)))
            first, second = (
                np.array(
                    [
                        float(k in set(tree.ancestors(joint)) - shared)
                        for k in range(tree.nj)
                    ]
                )
                for joint in key
            )
            index[key] = len(masks)
            masks.append((first, second))
        groups.append(index[key])
    order = np.argsort(groups, kind="stable")
    return [pairs[k] for k in order], [groups[k] for k in order], masks


def _radii(robot: Robot, i: int, j: int) -> float:
    return robot.spheres[i].radius + robot.spheres[j].radius


def _block_tables(
    pairs: list[tuple[int, int]], groups: list[int], count: int
) -> list[str]:
    """Blocks of a group: one sphere against a run of consecutive ones."""
    starts = [
        p
        for p, (i, j) in enumerate(pairs)
        if p == 0 or groups[p] != groups[p - 1] or pairs[p - 1] != (i, j - 1)
    ]
    owners = [groups[p] for p in starts]
    first = np.searchsorted(owners, range(count + 1))
    return [
        _c_table("int32_t", "t_block_pair", [*starts, len(pairs)]),
        _c_table("int32_t", "t_group_block", first),
    ]


def tables(robot: Robot) -> str:
    """Sizes and tables that the planner's runtime reads, as C text."""
    reaches, mask = reach(robot), ancestor_mask(robot).astype(float)
    pairs, groups, masks = _pair_groups(robot)
    pair_levers = [
        float(
            levers(robot, reaches[:, [i]], masks[g][0][:, None])[0]
            + levers(robot, reaches[:, [j]], masks[g][1][:, None])[0]
        )
        for (i, j), g in zip(pairs, groups, strict=True)
    ]
    bounds = range(len(masks) + 1)
    sizes = {
        "NV": robot.nv,
        "NJ": robot.tree.nj,
        "NS": len(robot.spheres),
        "NP": len(pairs),
        "NG": len(masks),
    }
    defines = "".join(f"#define {k} {v}\n" for k, v in sizes.items())
    moves = [sphere.joint != BASE for sphere in robot.spheres]
    double, integer = "double", "int32_t"
    return defines + "".join(
        [
            _c_table(double, "t_radius", [s.radius for s in robot.spheres]),
            _c_table(double, "t_idle", [0.0 if m else 1e300 for m in moves]),
            _c_table(double, "t_reach", reaches.T.ravel()),
            _c_table(double, "t_mask", mask.T.ravel()),
            _c_table(double, "t_lever", levers(robot, reaches, mask)),
            _c_table(integer, "t_pair_i", [i for i, _ in pairs]),
            _c_table(integer, "t_pair_j", [j for _, j in pairs]),
            _c_table(double, "t_pair_radius", [_radii(robot, *pair) for pair in pairs]),
            _c_table(integer, "t_group_first", np.searchsorted(groups, bounds)),
            *_block_tables(pairs, groups, len(masks)),
            _c_table(double, "t_pair_lever", pair_levers),
            _c_table(double, "t_group_i", np.ravel([m[0] for m in masks])),
            _c_table(double, "t_group_j", np.ravel([m[1] for m in masks])),
        ]
    )
