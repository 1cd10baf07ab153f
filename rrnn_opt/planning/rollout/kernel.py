"""The formulas of the printed schemes, from SX to C, for runtime/rollout.c."""

from __future__ import annotations

import pathlib

import casadi as ca
import numpy as np

from rrnn_opt import emit
from rrnn_opt.formulations.acceleration_limits import acceleration_bounds
from rrnn_opt.formulations.limits import velocity_bounds
from rrnn_opt.formulations.signs import Band
from rrnn_opt.formulations.slide import row
from rrnn_opt.networks import MemoryCell
from rrnn_opt.planning.kernel.source import source
from rrnn_opt.robot import Kinematics, Robot
from rrnn_opt.robot.bound import ancestor_mask

RUNTIME = ("rollout.c", "rollout_schemes.c", "rollout_search.c", "rollout_api.c")


def _tip_rows(robot: Robot, axes: ca.SX, origins: ca.SX, tip: ca.SX) -> ca.SX:
    """Position Jacobian of the tip, (3, nv), from the world axes."""
    moving = robot.tree.ancestors(robot.frame().joint)
    mask = ca.SX([float(k in moving) for k in range(robot.tree.nj)])
    unit = ca.SX.eye(3)
    rows = [row(robot.tree, axes, origins, mask, tip, unit[:, a]) for a in range(3)]
    return ca.densify(ca.vertcat(*rows))


def sign_functions(nv: int) -> list[ca.Function]:
    """Sign set (12) of one contact, and the drive that the network projects."""
    escape, moves, lower, upper, pull = (
        ca.SX.sym(name, nv) for name in ("escape", "moves", "lower", "upper", "pull")
    )
    back = escape < 0
    held = moves * (escape >= 0)
    cut = [
        ca.if_else(held, ca.fmax(lower, 0), lower),
        ca.if_else(back, ca.fmin(upper, 0), upper),
    ]
    box = [lower, upper]
    return [
        ca.Function(
            "k_sign_set",
            [escape, moves, *box],
            cut,
            ["escape", "moves", "lower", "upper"],
            ["least", "most"],
        ),
        ca.Function(
            "k_clamp",
            [pull, *box],
            [ca.fmin(ca.fmax(pull, lower), upper)],
            ["pull", "lower", "upper"],
            ["drive"],
        ),
    ]


def network_functions(robot: Robot, c1: float, c2: float) -> list[ca.Function]:
    """Limits (10), pull J'e/epsilon and relaxation of (17), Euler."""
    nv, nj = robot.nv, robot.tree.nj
    q, u, drive = (ca.SX.sym(name, nv) for name in ("q", "u", "drive"))
    axes, origins = ca.SX.sym("axes", 3, nj), ca.SX.sym("origins", 3, nj)
    tip, target = ca.SX.sym("tip_position", 3), ca.SX.sym("target", 3)
    epsilon, step = ca.SX.sym("epsilon"), ca.SX.sym("step")
    lower, upper = velocity_bounds(q, robot.limits, c1=c1, c2=c2)
    J, error = _tip_rows(robot, axes, origins, tip), target - tip
    return [
        ca.Function(
            "k_limits",
            [q],
            [ca.densify(lower), ca.densify(upper)],
            ["q"],
            ["lower", "upper"],
        ),
        ca.Function(
            "k_pull",
            [axes, origins, tip, target, epsilon],
            [ca.densify(J.T @ error / epsilon), ca.sqrt(ca.sumsqr(error))],
            ["axes", "origins", "tip_position", "target", "epsilon"],
            ["pull", "error"],
        ),
        ca.Function(
            "k_relax",
            [u, drive, epsilon, step],
            [u + step / epsilon * (drive - u)],
            ["u", "drive", "epsilon", "step"],
            ["next"],
        ),
        # transposed, so that row after row is contiguous in C
        ca.Function(
            "k_tip_rows",
            [axes, origins, tip],
            [J.T],
            ["axes", "origins", "tip_position"],
            ["rows"],
        ),
    ]


def scheme_functions(robot: Robot) -> list[ca.Function]:
    """Attraction, contact bands and accelerations of the comparison schemes."""
    return [*_task_functions(), *_acceleration_functions(robot)]


def _task_functions() -> list[ca.Function]:
    """Velocity towards the target, and how far a contact is inside its band."""
    tip, target = ca.SX.sym("tip", 3), ca.SX.sym("target", 3)
    gain, speed, gap = ca.SX.sym("gain"), ca.SX.sym("speed"), ca.SX.sym("gap")
    inner, outer = ca.SX.sym("inner"), ca.SX.sym("outer")
    unit, place = Band(0.0, 1.0), (gap - inner) / (outer - inner)
    error = target - tip
    length = ca.sqrt(ca.sumsqr(error))
    return [
        ca.Function(
            "k_attraction",
            [tip, target, gain, speed],
            [error * ca.fmin(gain, speed / ca.fmax(length, 1e-12)), length],
            ["tip", "target", "gain", "speed"],
            ["velocity", "error"],
        ),
        ca.Function(
            "k_band",
            [gap, inner, outer],
            [unit.share(place), unit.slope(place) / (outer - inner)],
            ["gap", "inner", "outer"],
            ["share", "slope"],
        ),
    ]


def _acceleration_functions(robot: Robot) -> list[ca.Function]:
    """Acceleration of the tip and the centres at rest, and limits of the joints'."""
    kin, qd = Kinematics(robot), ca.SX.sym("qd", robot.nv)
    lower, upper = acceleration_bounds(kin.q, qd, robot.limits)

    def drift(point: ca.SX) -> ca.SX:
        """Acceleration of points while the joint velocities stay the same."""
        velocity = ca.jtimes(ca.vec(point), kin.q, qd)
        return ca.densify(ca.jtimes(velocity, kin.q, qd))

    return [
        ca.Function(
            "k_drift",
            [kin.q, qd],
            [drift(kin.position()), drift(ca.transpose(kin.sphere_centres()))],
            ["q", "qd"],
            ["tip", "centers"],
        ),
        ca.Function(
            "k_acceleration_limits",
            [kin.q, qd],
            [ca.densify(lower), ca.densify(upper)],
            ["q", "qd"],
            ["lower", "upper"],
        ),
    ]


def moving_table(robot: Robot) -> str:
    """``t_turns``: which coordinate moves which sphere, (ns, nv), as C text."""
    source, mask = robot.tree.source, ancestor_mask(robot)
    turns = np.zeros((len(robot.spheres), robot.nv))
    for k in range(robot.tree.nj):
        turns[mask[k], int(source[k])] = 1.0
    entries = ", ".join(f"{value:.1f}" for value in turns.ravel())
    return f"static const double t_turns[{turns.size}] = {{{entries}}};\n"


def rollout_source(robot: Robot, cell: MemoryCell, c1: float, c2: float) -> str:
    """The planner's translation unit with the rollouts behind it, C99.

    Args:
        robot: the robot.
        cell: memory cell (14).
        c1: of (10), 1/s.
        c2: of (10), 1/s.
    """
    functions = [
        *sign_functions(robot.nv),
        *network_functions(robot, c1, c2),
        *scheme_functions(robot),
    ]
    texts = [emit.c_function(f, f.name()) for f in functions]
    room = pathlib.Path(__file__).parents[1] / "runtime"
    runtime = [(room / name).read_text("utf-8") for name in RUNTIME]
    head = [source(robot, cell), moving_table(robot)]
    return "\n".join([*head, *texts, *runtime])
