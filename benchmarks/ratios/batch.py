"""Many configurations at once: our lanes, CasADi's map, pinocchio in a loop.

Forward kinematics and Jacobian of the Panda's tip, then both with the signed distances
of 40 of its spheres to a box, time for one configuration: CPU time of the calling
thread, least of several runs, since the machine is shared.  Results are written into
memory that is used again, and fit into the second cache.  "fused" lets a product and a
sum be rounded once.  Pinocchio is its C++ behind its binding, one configuration a
call, as its users have it.  All agree to 1e-12 before anything is timed.
"""

from __future__ import annotations

import time
from collections.abc import Callable

import casadi as ca
import numpy as np

import rrnn_opt as rr
from benchmarks.ratios.kinematics import Peer, peer
from benchmarks.record import Benchmark, Row
from rrnn_opt import emit
from rrnn_opt.errors import RrnnError
from rrnn_opt.scene import Box
from rrnn_opt.scene.distance import PRIMITIVES

COUNT, SPHERES, REPEATS = 1024, 40, 25
WAYS = ((2, False), (4, False), (8, False), (8, True))
OBSTACLE = Box(
    "shelf", size=np.array([0.2, 0.3, 0.1]), position=np.array([0.5, 0.1, 0.4])
)


def run(benchmark: Benchmark) -> None:
    robot = rr.Robot.builtin("panda")
    q = np.random.default_rng(0).uniform(-1.0, 1.0, (robot.nv, COUNT))
    pinocchio = peer(robot)
    for fn in functions(robot):
        ours = emit.compile_batch(fn)
        require_agreement(fn, q, ours(q), pinocchio)
        benchmark.add(*rows(fn, q))
    columns = [q[:, k].copy() for k in range(COUNT)]
    each = cpu_each(lambda: [pinocchio(column) for column in columns], calls=1)
    benchmark.add(Row("FK + J: pinocchio, one by one from Python", each / COUNT, "s"))


def functions(robot: rr.Robot) -> tuple[ca.Function, ca.Function]:
    """Tip and Jacobian; the same and signed distances of the first spheres."""
    kin = rr.Kinematics(robot)
    shape, centres = ca.SX(OBSTACLE.pack()), kin.sphere_centres()
    gaps = [
        PRIMITIVES["box"](centres[:, k], shape)[0] - float(robot.spheres[k].radius)
        for k in range(SPHERES)
    ]
    tip = [kin.position(), kin.jacobian()]
    return (
        ca.Function("fk_and_j", [kin.q], tip),
        ca.Function("fk_j_and_gaps", [kin.q], [*tip, ca.vertcat(*gaps)]),
    )


def rows(fn: ca.Function, q: np.ndarray) -> list[Row]:
    """Ours at every width beside the loop over rows and CasADi's interpreter."""
    what = "FK + J" if fn.n_out() == 2 else f"FK + J + {SPHERES} distances"
    mapped, columns = fn.map(COUNT), np.asfortranarray(q)
    program, turned = emit.compile(fn), np.ascontiguousarray(q.T)
    casadi = cpu_each(lambda: mapped(columns), calls=2) / COUNT
    scalar = cpu_each(lambda: program.map(fn.name(), turned, n=COUNT), calls=20) / COUNT
    found = [
        Row(f"{what}: CasADi's map", casadi, "s"),
        Row(f"{what}: scalar C, one by one", scalar, "s", casadi / scalar),
    ]
    for lanes, fused in WAYS:
        try:
            batch = emit.compile_batch(fn, lanes=lanes, fused=fused)
        except RrnnError:  # not on this processor
            continue
        evaluate, _ = batch.bind(q)
        each = cpu_each(evaluate, calls=100) / COUNT
        name = f"{what}: {lanes} lanes{', fused' if fused else ''}"
        found.append(Row(name, each, "s", casadi / each))
    return found


def cpu_each(call: Callable[[], object], *, calls: int) -> float:
    """Least over repeats of the mean CPU time of one call."""
    call()
    least = np.inf
    for _ in range(REPEATS):
        begin = time.thread_time()
        for _ in range(calls):
            call()
        least = min(least, (time.thread_time() - begin) / calls)
    return float(least)


def require_agreement(
    fn: ca.Function, q: np.ndarray, ours: tuple[np.ndarray, ...], pinocchio: Peer
) -> None:
    """All give the same numbers, or nothing is timed."""
    for k in range(0, COUNT, 32):
        for mine, interpreted in zip(ours, fn(q[:, k]), strict=True):
            near = np.asarray(interpreted).reshape(mine[..., k].shape)
            np.testing.assert_allclose(mine[..., k], near, atol=1e-12)
        for mine, theirs in zip(ours[:2], pinocchio(q[:, k]), strict=True):
            np.testing.assert_allclose(mine[..., k], theirs, atol=1e-12)
