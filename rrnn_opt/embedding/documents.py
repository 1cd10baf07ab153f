"""The pages of a package for people."""

from __future__ import annotations

from rrnn_opt.embedding.kernel import Kernel
from rrnn_opt.embedding.options import Options
from rrnn_opt.embedding.programme import Programme
from rrnn_opt.embedding.render import EXTENT, plain, template
from rrnn_opt.embedding.vectors import HOST_CASES
from rrnn_opt.emit.c99 import library_calls
from rrnn_opt.robot import Robot

_EXACT = """
## The exact solver

Where the residual is above `param.tolerance` a dual active-set method (Goldfarb and
Idnani, 1983) solves the programme itself: {n} unknowns, {p} equality and {m} inequality
rows. It makes at most {steps} partial steps{rounds}, allocates nothing, and its
output keeps the bounds to the last bit.{restart}
"""


def readme(
    kernel: Kernel,
    words: dict[str, str],
    options: Options,
    close: float,
    exact: Programme | None,
    longest: float | None,
    robot: Robot | None,
) -> str:
    """README.md.

    Args:
        kernel: the functions.
        words: of ``render.common_words``.
        options: what was asked for.
        close: tolerance of the package's own test.
        exact: programme of the fallback; None without.
        longest: Euler step, s, up to which a bound is known; None without.
        robot: whose joints and tip the arguments speak of, if it is known.
    """
    form = kernel.dynamics.formulation
    fields = [*(("in", f) for f in kernel.inputs), ("out", kernel.output)]
    notes = [form.notes if form else "", kernel.dynamics.notes]
    said = "\n\n".join(plain(note) for note in notes if note)
    return template(
        "package.md",
        words
        | {
            "citation": plain(form.citation) if form else "",
            "notes": f"\n{said}\n" if said else "",
            "rows": "\n".join(
                f"| {struct} | `{f.name}` | {f.shape[0]} x {f.shape[1]} |"
                f" {plain(f.unit)} | {plain(f.meaning)} |"
                for struct, f in fields
            ),
            "robot_text": "" if robot is None else _robot(robot, options.prefix),
            "library": ", ".join(_library(kernel, options)) or "none",
            "angle": f"{EXTENT[options.real]:g}",
            "contract": "fast" if options.fused else "off",
            "longest_text": "" if longest is None else f", at most {longest:.6g}",
            "fallback_text": "the exact solver answers"
            if exact is not None
            else "the verdict says so",
            "exact_section": "" if exact is None else _exact(exact),
            "certified": _certified(options, close, longest),
        },
    )


def _robot(robot: Robot, prefix: str) -> str:
    names = ", ".join(f"`{plain(name)}`" for name in robot.joint_names)
    return (
        f" Joints stand in this order: {names}. The frame is"
        f" `{plain(robot.tip)}`, in coordinates of the robot's base;"
        f" `{prefix}_kinematics` gives its pose and Jacobian."
    )


def misra(words: dict[str, str]) -> str:
    """MISRA.md."""
    return template("misra.md", words)


def _library(kernel: Kernel, options: Options) -> list[str]:
    turning = ["sin", "cos"] if options.trig == "libm" else []
    return [*turning, *library_calls(kernel.tape)]


def _exact(exact: Programme) -> str:
    n, p, m = exact.sizes
    singular = exact.factor.proximal > 0.0
    going_on = " The network goes on from its solution." if exact.restart else ""
    return _EXACT.format(
        n=n,
        p=p,
        m=m,
        steps=4 * (3 * n + p + m),
        rounds=", in at most 200 proximal rounds," if singular else "",
        restart=going_on,
    )


def _certified(options: Options, close: float, longest: float | None) -> str:
    if options.exact:
        how = (
            f"bit for bit, on {HOST_CASES} cases (`test/`) and on a few of them at"
            " every start-up; with `-ffp-contract=off` and without `-ffast-math` the"
            " operations are those of the model, one by one"
        )
    else:
        how = f"to {close:g} relative to the larger of 1 and x, on {HOST_CASES} cases"
    lines = [
        f"- Tested: the code computes what the model says, {how}.",
        f"- Tested: the cases are within {close:g} of CasADi in double precision.",
        "- By construction: no globals, no allocation, no input or output, one state a"
        " controller, bounded loops; any bits in the inputs give a status.",
    ]
    if longest is not None:
        lines.append(
            f"- Derived over the reals, rounding left out: with the data standing still"
            f" no Euler step up to {longest:.6g} s goes away from a solution, wherever"
            " the arm is within its position limits and whatever is active (B. He,"
            " Applied Mathematics and Optimization 35, 1997, with bounds of the rows)."
            " init refuses longer steps. See `claims` in MANIFEST.json."
        )
    return "\n".join(lines)
