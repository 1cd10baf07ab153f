"""Constants of a robot as C tables: radii, reaches, masks, self pairs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.robot.reach import ancestor_mask, reach
from rrnn_opt.robot.robot import Robot
from rrnn_opt.robot.tree import BASE, PRISMATIC

Array = NDArray[np.float64]
LANES = 8
"""Spheres or sphere pairs that the runtime looks at together."""
FAR = 1e300


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


def _padded(values: Array, fill: float) -> Array:
    """Columns filled up to a multiple of ``LANES``."""
    missing = -values.shape[-1] % LANES
    return np.pad(values, [(0, 0), (0, missing)], constant_values=fill)


def _sphere_tables(robot: Robot, reaches: Array, mask: Array) -> list[str]:
    """Radii, reaches and levers of the spheres, a joint after the other.

    Lanes without a sphere that can move have a radius of -1e300, which puts
    them out of reach of everything.
    """
    moves = [sphere.joint != BASE for sphere in robot.spheres]
    radii = [s.radius if m else -FAR for s, m in zip(robot.spheres, moves, strict=True)]
    return [
        _c_table("double", "t_radius", _padded(np.array([radii]), -FAR).ravel()),
        _c_table("double", "t_lane_reach", _padded(reaches, 0.0).ravel()),
        _c_table("double", "t_lane_mask", _padded(mask, 0.0).ravel()),
        _c_table(
            "double",
            "t_lever",
            _padded(levers(robot, reaches, mask)[None], 0.0).ravel(),
        ),
        _c_table("double", "t_reach", reaches.T.ravel()),
        _c_table("double", "t_mask", mask.T.ravel()),
    ]


def _runs(pairs: list[tuple[int, int]]) -> Iterator[list[tuple[int, int]]]:
    """Pairs (i, j), (i, j + 1), ... of one sphere i, at most ``LANES`` at once."""
    run: list[tuple[int, int]] = []
    for i, j in pairs:
        if run and (len(run) == LANES or run[-1] != (i, j - 1)):
            yield run
            run = []
        run.append((i, j))
    if run:
        yield run


def _pair_lanes(
    robot: Robot, reaches: Array, run: list[tuple[int, int]], masks: tuple[Array, Array]
) -> tuple[Array, Array, Array]:
    """Radii and levers of a block's lanes, and the largest reach of each joint."""
    radii, rates = np.full(LANES, -FAR), np.zeros(LANES)
    ways = np.zeros(len(reaches))
    for lane, pair in enumerate(run):
        columns = [
            reaches[:, [s]] * m[:, None] for s, m in zip(pair, masks, strict=True)
        ]
        radii[lane] = sum(robot.spheres[s].radius for s in pair)
        rates[lane] = sum(
            float(levers(robot, reaches[:, [s]], m[:, None])[0])
            for s, m in zip(pair, masks, strict=True)
        )
        ways = np.maximum(ways, (columns[0] + columns[1])[:, 0])
    return radii, rates, ways


def _firsts(groups: list[int]) -> list[int]:
    """Where each group begins, and at last where they end."""
    return [groups.index(g) for g in dict.fromkeys(groups)] + [len(groups)]


def _pair_tables(robot: Robot, reaches: Array) -> tuple[dict[str, int], list[str]]:
    """Sphere pairs in blocks: one sphere i against ``LANES`` consecutive ones."""
    pairs, groups, masks = _pair_groups(robot)
    blocks: list[tuple[int, int, int]] = []
    radii, rates = np.zeros((0, LANES)), np.zeros((0, LANES))
    ways = np.zeros((robot.tree.nj, len(masks)))
    for g, mask in enumerate(masks):
        mine = [pair for pair, group in zip(pairs, groups, strict=True) if group == g]
        for run in _runs(mine):
            blocks.append((*run[0], g))
            radius, rate, way = _pair_lanes(robot, reaches, run, mask)
            radii, rates = np.vstack([radii, radius]), np.vstack([rates, rate])
            ways[:, g] = np.maximum(ways[:, g], way)
    either = np.array([np.maximum(*m) for m in masks]).reshape(-1, robot.tree.nj).T
    sizes = {"NG": len(masks), "NQ": len(blocks), "NGP": _padded(ways, 0.0).shape[1]}
    return sizes, [
        _c_table("int32_t", "t_pair_i", [i for i, _, _ in blocks]),
        _c_table("int32_t", "t_pair_j", [j for _, j, _ in blocks]),
        _c_table("int32_t", "t_pair_group", [g for _, _, g in blocks]),
        _c_table("int32_t", "t_group_first", _firsts([g for _, _, g in blocks])),
        _c_table("double", "t_pair_radius", radii.ravel()),
        _c_table("double", "t_pair_lever", rates.ravel()),
        _c_table("double", "t_pair_idle", np.where(radii > 0.0, 0.0, FAR).ravel()),
        _c_table("double", "t_pair_size", np.max(radii, axis=1, initial=-FAR)),
        _c_table("double", "t_pair_rate", np.max(rates, axis=1, initial=0.0)),
        _c_table("double", "t_group_reach", _padded(ways, 0.0).ravel()),
        _c_table("double", "t_group_mask", _padded(either, 0.0).ravel()),
        _c_table("double", "t_group_i", np.ravel([m[0] for m in masks])),
        _c_table("double", "t_group_j", np.ravel([m[1] for m in masks])),
    ]


def tables(robot: Robot) -> str:
    """Sizes and tables that the planner's runtime reads, as C text.

    ``NS`` spheres lie in ``NSP`` lanes, ``NB`` blocks of ``LANES``; ``NQ``
    blocks hold the sphere pairs of ``NG`` groups in ``NGP`` lanes.
    """
    reaches, mask = reach(robot), ancestor_mask(robot).astype(float)
    spheres = len(robot.spheres)
    blocks = -(-spheres // LANES)
    pair_sizes, pair_tables = _pair_tables(robot, reaches)
    sizes = {
        "LANES": LANES,
        "NV": robot.nv,
        "NJ": robot.tree.nj,
        "NS": spheres,
        "NB": blocks,
        "NSP": LANES * blocks,
        **pair_sizes,
    }
    defines = "".join(f"#define {k} {v}\n" for k, v in sizes.items())
    return defines + "".join([*_sphere_tables(robot, reaches, mask), *pair_tables])
