"""The formulas of the printed schemes, from SX to C, for runtime/rollout.c."""

from __future__ import annotations

import pathlib

import casadi as ca
import numpy as np

from rrnn_opt import emit
from rrnn_opt.formulations.acceleration_limits import acceleration_bounds
from rrnn_opt.formulations.limits import velocity_bounds
from rrnn_opt.formulations.signs import Band
from rrnn_opt.networks import MemoryCell
from rrnn_opt.planning.kernel.drives import tip_jacobian
from rrnn_opt.planning.kernel.function import emitted_function
from rrnn_opt.planning.kernel.source import source
from rrnn_opt.robot import Kinematics, Robot
from rrnn_opt.robot.reach import ancestor_mask

RUNTIME = ("rollout.c", "rollout_schemes.c", "rollout_search.c", "rollout_api.c")


def sign_functions(nv: int) -> list[ca.Function]:
    """Sign set (12) of one contact, and the drive that the network projects."""
    escape, moves, lower, upper, pull = (
        ca.SX.sym(name, nv) for name in ("escape", "moves", "lower", "upper", "pull")
    )
    back = escape < 0
    held = moves * (escape >= 0)
    box = {"lower": lower, "upper": upper}
    cut = {
        "least": ca.if_else(held, ca.fmax(lower, 0), lower),
        "most": ca.if_else(back, ca.fmin(upper, 0), upper),
    }
    drive = ca.fmin(ca.fmax(pull, lower), upper)
    return [
        emitted_function("k_sign_set", {"escape": escape, "moves": moves, **box}, cut),
        emitted_function("k_clamp", {"pull": pull, **box}, {"drive": drive}),
    ]


def network_functions(robot: Robot, c1: float, c2: float) -> list[ca.Function]:
    """Limits (10), pull J'e/epsilon and relaxation of (17), Euler."""
    nv, nj = robot.nv, robot.tree.nj
    q, u, drive = (ca.SX.sym(name, nv) for name in ("q", "u", "drive"))
    axes, origins = ca.SX.sym("axes", 3, nj), ca.SX.sym("origins", 3, nj)
    tip, target = ca.SX.sym("tip_position", 3), ca.SX.sym("target", 3)
    epsilon, step = ca.SX.sym("epsilon"), ca.SX.sym("step")
    lower, upper = velocity_bounds(q, robot.limits, c1=c1, c2=c2)
    moving = robot.tree.ancestors(robot.frame().joint)
    J = ca.densify(tip_jacobian(robot.tree, moving, axes, origins, tip))
    error = target - tip
    frame = {"axes": axes, "origins": origins, "tip_position": tip}
    return [
        emitted_function("k_limits", {"q": q}, {"lower": lower, "upper": upper}),
        emitted_function(
            "k_pull",
            {**frame, "target": target, "epsilon": epsilon},
            {"pull": J.T @ error / epsilon, "error": ca.sqrt(ca.sumsqr(error))},
        ),
        emitted_function(
            "k_relax",
            {"u": u, "drive": drive, "epsilon": epsilon, "step": step},
            {"next": u + step / epsilon * (drive - u)},
        ),
        # transposed, so that row after row is contiguous in C
        emitted_function("k_tip_rows", frame, {"rows": J.T}),
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
    velocity = error * ca.fmin(gain, speed / ca.fmax(length, 1e-12))
    return [
        emitted_function(
            "k_attraction",
            {"tip": tip, "target": target, "gain": gain, "speed": speed},
            {"velocity": velocity, "error": length},
        ),
        emitted_function(
            "k_band",
            {"gap": gap, "inner": inner, "outer": outer},
            {"share": unit.share(place), "slope": unit.slope(place) / (outer - inner)},
        ),
    ]


def _acceleration_functions(robot: Robot) -> list[ca.Function]:
    """Acceleration of the tip and the centres at rest, and limits of the joints'."""
    kin, qd = Kinematics(robot), ca.SX.sym("qd", robot.nv)
    lower, upper = acceleration_bounds(kin.q, qd, robot.limits)

    def drift(point: ca.SX) -> ca.SX:
        """Acceleration of points while the joint velocities stay the same."""
        velocity = ca.jtimes(ca.vec(point), kin.q, qd)
        return ca.jtimes(velocity, kin.q, qd)

    state = {"q": kin.q, "qd": qd}
    centres = ca.transpose(kin.sphere_centres())
    return [
        emitted_function(
            "k_drift", state, {"tip": drift(kin.position()), "centers": drift(centres)}
        ),
        emitted_function(
            "k_acceleration_limits", state, {"lower": lower, "upper": upper}
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
