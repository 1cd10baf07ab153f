"""``certify_region``: how fast, and with what step, the reduced law converges."""

from __future__ import annotations

import itertools
import os
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from rrnn_opt.arguments import checked
from rrnn_opt.errors import RrnnError, ShapeError
from rrnn_opt.robot import Kinematics, Robot
from rrnn_opt.verification.engines.interval.kernel import Array
from rrnn_opt.verification.region.cell import Law, Tools, certify_cell
from rrnn_opt.verification.region.result import Region, RegionCell, RegionMap

Tile = tuple[tuple[float, float], tuple[float, float]]


@checked()
def certify_region(
    arm: Robot | Kinematics,
    region: Region | None = None,
    *,
    epsilon: float,
    delta: float | None = None,
    error: float = 0.1,
    gain: float = 0.5,
    floor: float = 0.02,
    frame: str | None = None,
    joints: tuple[int, int] | None = None,
    grid: tuple[int, int] = (8, 8),
    budget_s: float = 60.0,
    jobs: int | None = None,
) -> RegionMap:
    """Certified rate and step of the reduced law (18) over a region.

    The law is q' = P(x), x = J(q)' e / epsilon, e = r_d - f(q), with r_d at
    rest and P the projection on the velocity bounds [d-, d+] of (9).  With
    V = e'e / 2 the **theorem** says: at every q of the certified part of the
    region and every e with 0 < |e| <= E,

        V' <= -alpha V,   alpha = (2 sigma^2 / epsilon) min(1, delta / X),

    where sigma_min(J(q)) >= sigma, d- <= -delta and delta <= d+ in every
    joint, and X >= |x_i|.  For V' = -epsilon x'P(x), and in each joint
    x_i P_i(x_i) >= min(1, delta / X) x_i^2, while epsilon |x| >= sigma |e|.
    An Euler step of length h from q to q + h P(x), both ends (hence, boxes being
    convex, all between) in one certified box, keeps V from growing when
    h <= 2 epsilon / L, L >= the norm of the Hessian of |e|^2 / 2 for |e| <= E
    all along the step.

    It does **not** say that the motion stays where the bounds hold: that must
    be shown besides, for instance by a sublevel set of V inside the certified
    part.  Nor does it speak of (17), whose error may grow at first.

    What is certified: sigma by Weyl's inequality on boxes (see
    :mod:`rrnn_opt.verification.region.singular`), X and L by interval forms,
    delta from the limits (10) of the robot unless it is given.  Arithmetic is
    rounded outwards; the model is that of the robot's doubles.  Joints that
    cannot change the singular values are left out of the search.

    Args:
        arm: a robot, or its kinematics.
        region: where; :meth:`Region.working` by default.
        epsilon: of (18), positive, s.
        delta: assume velocity bounds at least this far from 0, rad/s; by
            default those of (10) are taken, and must contain 0.
        error: E, the largest |e| spoken of, m.
        gain: c of (10), 1/s.
        floor: do not certify boxes with a bound of sigma_min below this, m.
        frame: the task's frame; the tip by default.
        joints: the two joints of the map; by default those that change
            sigma_min most.
        grid: tiles along the two.
        budget_s: wall time of the search, s; what is open then stays open.
            Compiling the kernels of a new arm takes some seconds more, once.
        jobs: threads; by default one a core.

    Returns:
        The map.

    Raises:
        RrnnError: a number is out of range, the region is not of this arm, or
            the arm has too few joints for the task.
        UnsupportedOperationError: intervals cannot do an operation of J.

    Source:
        Random recurrent neural network planner, eqs. (9), (10), (18), (19),
        (21), with the constant of (21) made explicit.
    """
    begin = time.monotonic()
    kinematics = arm if isinstance(arm, Kinematics) else Kinematics(arm)
    region = region or Region.working(kinematics)
    law = Law(epsilon, error, delta, gain, floor)
    _require(region, kinematics, law, grid, joints)
    tools = Tools.of(kinematics, frame)
    pair = joints or telling_joints(tools, region)
    end = time.monotonic() + budget_s
    cells = _cells(tools, law, region, pair, grid, end, jobs)
    return RegionMap(
        kinematics.robot.name,
        region,
        pair,
        epsilon,
        error,
        floor,
        tuple(cells),
        assumptions_of(law),
        time.monotonic() - begin,
    )


def _require(
    region: Region,
    kinematics: Kinematics,
    law: Law,
    grid: tuple[int, int],
    joints: tuple[int, int] | None,
) -> None:
    nv = kinematics.robot.nv
    if len(region.centre) != nv:
        raise ShapeError("region", (nv,), (len(region.centre),))
    delta = 1.0 if law.delta is None else law.delta
    if not (min(law.epsilon, law.error, law.gain, delta) > 0.0 and min(grid) >= 1):
        raise RrnnError(
            "certify_region: epsilon, error, gain, delta and grid must be positive"
        )
    if joints is not None and not all(0 <= k < nv for k in joints):
        raise RrnnError(f"certify_region: joints {joints}: they are 0 to {nv - 1}")


def assumptions_of(law: Law) -> tuple[str, ...]:
    """What the theorem needs besides the certified bounds."""
    given = () if law.delta is None else (f"velocity bounds {law.delta:g} from 0",)
    return (
        "the target is at rest",
        f"|e| <= {law.error:g} m",
        "the motion stays in the certified part (forward invariance)",
        *given,
    )


def telling_joints(tools: Tools, region: Region) -> tuple[int, int]:
    """The two joints that loosen the bound most, at 64 drawn points."""
    active = list(tools.arm.joints)
    half = np.array(region.half_widths)[active][:, None]
    draws = np.random.default_rng(0).uniform(-1.0, 1.0, (len(active), 64))
    point = np.array(region.centre)[active][:, None] + half * draws
    spread = tools.singular(point - 0.05 * half, point + 0.05 * half).spread.mean(
        axis=1
    )
    order = np.argsort(-spread)[:2]
    chosen = sorted(active[k] for k in order)
    return (chosen[0], chosen[-1])


def tiles(
    region: Region, pair: tuple[int, int], grid: tuple[int, int]
) -> Iterator[tuple[Array, Array, Tile]]:
    """Boxes in all joints, and their ends in the two of the map."""
    lower, upper = region.lower, region.upper
    edges = [
        np.linspace(lower[k], upper[k], n + 1) for k, n in zip(pair, grid, strict=True)
    ]
    counts = (grid[0], grid[1] if pair[0] != pair[1] else 1)
    for i, j in itertools.product(range(counts[0]), range(counts[1])):
        low, high = lower.copy(), upper.copy()
        for k, edge, at in zip(pair, edges, (i, j), strict=True):
            low[k], high[k] = edge[at], edge[at + 1]
        a, b = (float(low[k]) for k in pair), (float(high[k]) for k in pair)
        yield low, high, ((next(a), next(a)), (next(b), next(b)))


def _cells(
    tools: Tools,
    law: Law,
    region: Region,
    pair: tuple[int, int],
    grid: tuple[int, int],
    end: float,
    jobs: int | None,
) -> list[RegionCell]:
    """All tiles; each gets an equal share of the time that is left."""
    work = list(tiles(region, pair, grid))
    workers = max(1, jobs or os.cpu_count() or 1)
    waiting = len(work)

    def one(item: tuple[Array, Array, Tile]) -> RegionCell:
        nonlocal waiting
        share = max(0.0, end - time.monotonic()) * workers / max(1, waiting)
        waiting -= 1
        return certify_cell(tools, law, *item, seconds=share)

    with ThreadPoolExecutor(workers) as pool:
        return list(pool.map(one, work))
