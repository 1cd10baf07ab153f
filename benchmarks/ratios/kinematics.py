"""Forward kinematics and Jacobian of the tip: our C, pinocchio, CasADi's interpreter.

Two fair pairs: called from Python for one configuration at a time (ours beside
pinocchio's own C++ behind its binding), and whole batches that never come back
to Python (ours beside CasADi's interpreter).  All agree to 1e-12 before anything
is timed.
"""

from __future__ import annotations

from collections.abc import Callable

import casadi as ca
import numpy as np
import pinocchio as pin

import rrnn_opt as rr
from benchmarks.record import Benchmark, Row, seconds_each
from rrnn_opt import emit

ROBOTS = ("pa10", "panda")
BATCH = 2000
Peer = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]


def pinocchio_model(robot: rr.Robot) -> tuple[pin.Model, int]:
    """The same tree as a pinocchio model, and the id of its tip frame."""
    model, tree = pin.Model(), robot.tree
    for k in range(tree.nj):
        axis = np.array(tree.axes[k])
        prismatic = tree.types[k] == "prismatic"
        kind = pin.JointModelPrismaticUnaligned if prismatic else None
        joint = (kind or pin.JointModelRevoluteUnaligned)(axis)
        placement = pin.SE3(np.array(tree.placements[k]))
        model.addJoint(int(tree.parents[k]) + 1, joint, placement, f"j{k}")
    tip = robot.frame()
    placement = pin.SE3(np.array(tip.placement))
    frame = pin.Frame("tip", tip.joint + 1, 0, placement, pin.FrameType.OP_FRAME)
    return model, model.addFrame(frame)


def peer(robot: rr.Robot) -> Peer:
    """Tip position and Jacobian (3, nv) by pinocchio."""
    model, tip = pinocchio_model(robot)
    data, aligned = model.createData(), pin.LOCAL_WORLD_ALIGNED

    def evaluate(q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        jacobian = pin.computeFrameJacobian(model, data, q, tip, aligned)
        pin.updateFramePlacement(model, data, tip)
        return data.oMf[tip].translation, jacobian[:3]

    return evaluate


def run(benchmark: Benchmark) -> None:
    for name in ROBOTS:
        benchmark.add(*rows(name))


def rows(name: str) -> tuple[Row, ...]:
    robot = rr.Robot.builtin(name)
    kin = rr.Kinematics(robot)
    fn = ca.Function("tip", [kin.q], [kin.position(), kin.jacobian()])
    program, pinocchio = emit.compile(fn), peer(robot)
    q = np.random.default_rng(0).uniform(-1.0, 1.0, (BATCH, robot.nv))
    require_agreement(q, program.map("tip", q, n=BATCH), pinocchio, fn)
    one, out = q[0].copy(), program.call("tip", q[0].copy())
    ours = seconds_each(lambda: program.call("tip", one, out=out), calls=2000)
    pins = seconds_each(lambda: pinocchio(one), calls=2000)
    batch = seconds_each(lambda: program.map("tip", q, n=BATCH), calls=1) / BATCH
    mapped, columns = fn.map(BATCH), np.asfortranarray(q.T)
    vm = seconds_each(lambda: mapped(columns), calls=1) / BATCH
    return (
        Row(f"{name}: ours, called from Python", ours, "s"),
        Row(f"{name}: pinocchio, called from Python", pins, "s", pins / ours),
        Row(f"{name}: ours, batch in C", batch, "s"),
        Row(f"{name}: CasADi's interpreter, batch", vm, "s", vm / batch),
    )


def require_agreement(
    q: np.ndarray, ours: tuple[np.ndarray, ...], pinocchio: Peer, fn: ca.Function
) -> None:
    """All three give the same numbers, or nothing is timed."""
    for k in range(0, len(q), 100):
        theirs, interpreted = pinocchio(q[k]), fn(q[k])
        for i in (0, 1):
            near = np.asarray(interpreted[i]).reshape(ours[i][k].shape)
            np.testing.assert_allclose(ours[i][k], theirs[i], atol=1e-12)
            np.testing.assert_allclose(ours[i][k], near, atol=1e-12)
