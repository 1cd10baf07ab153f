"""The planner's symbolic half: every formula of its runtime, from SX to C.

The hand-written runtime holds loops, trees and linear algebra.  Frames,
drives, distances, rows, bounds and the memory cell are written here once, as
CasADi functions, and emitted in front of it into the same translation unit.
"""

from __future__ import annotations

import pathlib

import casadi as ca

from rrnn_opt import emit
from rrnn_opt.formulations.slide import offset, row, step_box
from rrnn_opt.networks import MemoryCell
from rrnn_opt.planning.kernel.dispatch import dispatch
from rrnn_opt.planning.kernel.drives import drive_functions
from rrnn_opt.planning.kernel.function import emitted_function
from rrnn_opt.planning.kernel.tables import LANES, tables
from rrnn_opt.robot import Kinematics, Robot
from rrnn_opt.robot.motion_bound import motion_bound, travel
from rrnn_opt.scene.distance import PRIMITIVES, distance_function

RUNTIME = (
    "rng.h",
    "types.h",
    "cancel.c",
    "memory.c",
    "broad.c",
    "blocks.c",
    "pairs.c",
    "world.c",
    "project.c",
    "slide.c",
    "tree.c",
    "goals.c",
    "search.c",
    "segment.c",
    "shorten.c",
    "open.c",
    "api.c",
)
PREFIX = "rrnn_planner_"


def frames_functions(kin: Kinematics) -> list[ca.Function]:
    """``q -> axes, origins, centers, tip_position, tip_rotation``; without centers.

    Centres lie coordinate by coordinate, filled up to whole blocks of lanes,
    (nsp, 3), so that loops over spheres read contiguous numbers.
    """
    tip, centres = kin.pose(), ca.transpose(kin.sphere_centres())
    missing = -centres.shape[0] % LANES
    frames = {"axes": kin.axes(), "origins": kin.origins()}
    spheres = {"centers": ca.vertcat(centres, ca.SX.zeros(missing, 3))}
    ends = {"tip_position": tip[:3, 3], "tip_rotation": tip[:3, :3]}
    return [
        emitted_function("k_frames", {"q": kin.q}, {**frames, **spheres, **ends}),
        emitted_function("k_tip_frames", {"q": kin.q}, {**frames, **ends}),
    ]


def row_functions(robot: Robot) -> list[ca.Function]:
    """Contact row, and the step's box."""
    tree, nj, nv = robot.tree, robot.tree.nj, robot.nv
    axes, origins = ca.SX.sym("axes", 3, nj), ca.SX.sym("origins", 3, nj)
    mask = ca.SX.sym("mask", nj)
    point, n = ca.SX.sym("point", 3), ca.SX.sym("n", 3)
    q, low, high = (ca.SX.sym(name, nv) for name in ("q", "lower", "upper"))
    radius = ca.SX.sym("radius")
    lower, upper = step_box(q, low, high, radius)
    frame = {"axes": axes, "origins": origins}
    return [
        emitted_function(
            "k_row",
            {**frame, "mask": mask, "point": point, "n": n},
            {"row": row(tree, axes, origins, mask, point, n)},
        ),
        emitted_function(
            "k_box",
            {"q": q, "lower": low, "upper": high, "radius": radius},
            {"least": lower, "most": upper},
        ),
    ]


def offset_function() -> ca.Function:
    """Right-hand side of a contact row: ``gap, margin, bound -> right``."""
    gap, margin, bound = (ca.SX.sym(name) for name in ("gap", "margin", "bound"))
    return emitted_function(
        "k_offset",
        {"gap": gap, "margin": margin, "bound": bound},
        {"right": offset(gap, margin, bound)},
    )


def motion_functions(robot: Robot) -> list[ca.Function]:
    """What an increment u does to one sphere: velocity J u, bound B, way."""
    tree, nj, nv = robot.tree, robot.tree.nj, robot.nv
    axes, origins = ca.SX.sym("axes", 3, nj), ca.SX.sym("origins", 3, nj)
    mask, lever = ca.SX.sym("mask", nj), ca.SX.sym("reach", nj)
    point, u, eye = ca.SX.sym("point", 3), ca.SX.sym("u", nv), ca.SX.eye(3)
    along = [row(tree, axes, origins, mask, point, eye[:, i]) @ u for i in range(3)]
    place = {"axes": axes, "origins": origins, "mask": mask, "point": point}
    rates = {"u": u, "reach": lever, "mask": mask}
    bound, way = motion_bound(tree, u, lever, mask), travel(tree, u, lever, mask)
    return [
        emitted_function(
            "k_velocity", {**place, "u": u}, {"velocity": ca.vertcat(*along)}
        ),
        emitted_function("k_motion_bound", rates, {"bound": bound}),
        emitted_function("k_travel", rates, {"way": way}),
    ]


def pair_functions() -> list[ca.Function]:
    """Distance of two points with the unit vector between them; its square."""
    a, b = ca.SX.sym("a", 3), ca.SX.sym("b", 3)
    d = ca.sqrt(ca.sumsqr(b - a))
    n = (b - a) / ca.fmax(d, 1e-12)
    points = {"a": a, "b": b}
    return [
        emitted_function("k_distance_pair", points, {"d": d, "n": n}),
        emitted_function("k_square", points, {"square": ca.sumsqr(b - a)}),
    ]


def cell_functions(cell: MemoryCell) -> list[ca.Function]:
    """The memory cell's exact step, and the square root."""
    x = ca.SX.sym("x")
    return [
        cell.function("k_memory"),
        emitted_function("k_sqrt", {"x": x}, {"root": ca.sqrt(x)}),
    ]


def gap_function(kind: str) -> ca.Function:
    """Distance of a point to a solid without its normal: ``p, shape -> d``."""
    p, shape = ca.SX.sym("p", 3), ca.SX.sym("shape", 16)
    return emitted_function(
        f"k_gap_{kind}", {"p": p, "shape": shape}, {"d": PRIMITIVES[kind](p, shape)[0]}
    )


def bounds_function() -> ca.Function:
    """Distance of a point to a box along the world's axes: ``p, bounds -> d``."""
    p, bounds = ca.SX.sym("p", 3), ca.SX.sym("bounds", 6)
    out = ca.fmax(ca.fmax(bounds[:3] - p, p - bounds[3:]), 0)
    return emitted_function(
        "k_gap_bounds", {"p": p, "bounds": bounds}, {"d": ca.sqrt(ca.sumsqr(out))}
    )


def emitted(robot: Robot, cell: MemoryCell) -> str:
    """The emitted half of the translation unit: tables and functions."""
    functions = [
        *frames_functions(Kinematics(robot)),
        *row_functions(robot),
        *drive_functions(robot),
        *cell_functions(cell),
    ]
    lanes = [*motion_functions(robot), *pair_functions()]
    lanes += [bounds_function(), offset_function()]
    named = [(f, f.name()) for f in lanes]
    named += [(distance_function(kind), f"k_distance_{kind}") for kind in PRIMITIVES]
    named += [(gap_function(kind), f"k_gap_{kind}") for kind in PRIMITIVES]
    texts = [emit.c_function(f, f.name(), compact=True) for f in functions]
    texts += [emit.c_function(f, name, inline=True) for f, name in named]
    loops = dispatch(tuple(PRIMITIVES), robot.tree.nj)
    return "\n".join([tables(robot), *texts, loops])


def source(robot: Robot, cell: MemoryCell) -> str:
    """The whole translation unit of a robot's planner, C99."""
    room = pathlib.Path(__file__).parents[1] / "runtime"
    runtime = [(room / name).read_text("utf-8") for name in RUNTIME]
    head = f"#define _POSIX_C_SOURCE 199309L\n#define NAME(x) {PREFIX}##x\n"
    prologue = emit.prologue("double", support=("hildreth.h",))
    return "\n".join([head, prologue, emitted(robot, cell), *runtime])
