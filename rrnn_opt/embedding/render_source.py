"""The sources of a package: header, controller, exact fallback."""

from __future__ import annotations

import numpy as np

from rrnn_opt.embedding.kernel import Kernel
from rrnn_opt.embedding.options import Options
from rrnn_opt.embedding.programme import Programme
from rrnn_opt.embedding.render import declaration, pointer, template
from rrnn_opt.embedding.render_monitor import monitor_words
from rrnn_opt.emit import c_function, prologue
from rrnn_opt.emit.active_set import FIELDS, active_set_source
from rrnn_opt.emit.c99 import literal
from rrnn_opt.symbolic.split import split
from rrnn_opt.symbolic.tape import Tape

_LARGEST = {"double": "DBL_MAX", "float": "FLT_MAX"}


def header(
    kernel: Kernel, options: Options, words: dict[str, str], pose: Tape | None
) -> str:
    """include/<prefix>.h."""
    struct, prototype = _kinematics_header(words, pose)
    real = f"{options.prefix}_real_t"
    return template(
        "header.h",
        words
        | {
            "state_fields": declaration(kernel.state, real),
            "in_fields": "\n".join(declaration(f, real) for f in kernel.inputs)
            or f"    {real} unused; /* the network has no parameters */",
            "out_fields": declaration(kernel.output, real),
            "selftest_how": " bit for bit" if options.exact else "",
            "kinematics_struct": struct,
            "kinematics_part": prototype,
        },
    )


def mathematics(options: Options) -> str:
    """src/<prefix>_math.h: types, sine and cosine."""
    guard = f"{options.prefix.upper()}_MATH_H"
    largest = f"#define RRNN_LARGEST_FINITE {_LARGEST[options.real]}\n"
    body = prologue(options.real, compact=True, trig=options.trig)
    return (
        f"/* {options.prefix}: numbers; included by {options.prefix}.c alone. */\n"
        f"#ifndef {guard}\n#define {guard}\n\n{body}\n{largest}\n#endif\n"
    )


def solver(programme: Programme, options: Options) -> str:
    """src/<prefix>_qp.h: the exact solver, in the programme's sizes."""
    guard = f"{options.prefix.upper()}_QP_H"
    proximal = programme.factor.proximal
    text = active_set_source(programme.sizes, proximal, options.real)
    return (
        f"/* {options.prefix}: exact solver; included by {options.prefix}.c alone. */\n"
        f"#ifndef {guard}\n#define {guard}\n\n"
        f"{text}\n#endif\n"
    )


def source(
    kernel: Kernel,
    options: Options,
    words: dict[str, str],
    programme: Programme | None,
    longest: float | None,
    pose: Tape | None,
) -> str:
    """src/<prefix>.c."""
    kernels, run = _steps(kernel, options)
    kernels += "\n" + c_function(
        kernel.monitor, "watch", real=options.real, compact=True
    )
    if pose is not None:
        kernels += "\n" + c_function(pose, "pose", real=options.real, compact=True)
    fallback = ""
    if programme is not None:
        kernels += "\n" + c_function(
            programme.tape, "programme", real=options.real, compact=True
        )
        fallback = _fallback(kernel, options, words, programme)
    return template(
        "source.c",
        words
        | _checks(kernel, words, longest)
        | monitor_words(kernel, words)
        | {
            "kernels": kernels,
            "run_steps": run,
            "room_default": "" if kernel.bounds else " = RRNN_C(0.0)",
            "fallback": fallback,
            "fallback_include": f'#include "{options.prefix}_qp.h"\n' * bool(fallback),
            "take_fallback": _take(words) * bool(fallback),
            "kinematics": _kinematics(words, pose),
        },
    )


def _kinematics_header(words: dict[str, str], pose: Tape | None) -> tuple[str, str]:
    """Struct and prototype of the forward kinematics."""
    if pose is None:
        return "", ""
    name, nv = words["prefix"], pose.inputs[0].size
    struct = (
        "\n/* Where the tip is; matrices column-major, in base axes. */\n"
        "typedef struct {\n"
        f"    {name}_real_t position[3]; /* [m] */\n"
        f"    {name}_real_t rotation[9]; /* 3x3 [1] */\n"
        f"    {name}_real_t jacobian[{6 * nv}];"
        f" /* 6x{nv}, linear then angular [m/rad or 1] */\n"
        f"}} {name}_kinematics_t;\n"
    )
    prototype = (
        "\n/* Pose and Jacobian of the tip at joint positions [rad or m].\n"
        " * On failure the result is left as it was. */\n"
        f"{name}_status_t {name}_kinematics(const {name}_real_t q[{nv}],\n"
        f"                                  {name}_kinematics_t *kinematics);\n"
    )
    return struct, prototype


def _kinematics(words: dict[str, str], pose: Tape | None) -> str:
    if pose is None:
        return ""
    return template("kinematics.c", words | {"nv": str(pose.inputs[0].size)})


def _checks(
    kernel: Kernel, words: dict[str, str], longest: float | None
) -> dict[str, str]:
    lines = [
        f"    if (all_finite({pointer('in->', f)}, {f.size}U) == 0) {{\n"
        "        finite = 0;\n    }\n"
        for f in kernel.inputs
    ]
    too_long = (
        f"    }} else if (param->step_size > {words['PREFIX']}_LONGEST_STEP) {{\n"
        f"        status = {words['PREFIX']}_STEP_TOO_LONG;\n"
    )
    return {
        "finite_checks": "".join(lines),
        "unused_in": "" if kernel.inputs else "    (void)in;\n",
        "step_check": too_long if longest is not None else "",
    }


def _steps(kernel: Kernel, options: Options) -> tuple[str, str]:
    """The kernels of the network's step, and the lines that call them."""
    results = ["next", "output", "&merit", "&residual", "&extent", "&size"]
    results += ["&room"] * bool(kernel.bounds)
    inputs = [pointer("in->", f) for f in kernel.inputs]
    if options.steps == 1:
        given = [pointer("state->", kernel.state), *inputs, "&state->step_size"]
        call = f"    advance({', '.join(given + results)});\n"
        return c_function(kernel.tape, "advance", real=options.real, compact=True), call
    last = len(kernel.tape.inputs) - 1
    setup, iterate = split(kernel.tape, late=(0, last))
    texts = [
        c_function(setup, "prepare", real=options.real, compact=True),
        c_function(iterate, "advance", real=options.real, compact=True),
    ]
    given = ["next", "&state->step_size", "work", *results]
    state = pointer("state->", kernel.state).removeprefix("&")
    begin = f"{state}[i]" if kernel.state.size > 1 else state
    call = (
        f"    real_t work[{setup.outputs[0].size}];\n"
        f"    prepare({', '.join([*inputs, 'work'])});\n"
        f"    for (i = 0U; i < {kernel.state.size}U; ++i) {{\n"
        f"        next[i] = {begin};\n    }}\n"
        f"    for (i = 0U; i < (uint32_t){words_steps(options)}; ++i) {{\n"
        f"        advance({', '.join(given)});\n    }}\n"
    )
    return "\n".join(texts), call


def words_steps(options: Options) -> str:
    """Macro of the number of steps."""
    return f"{options.prefix.upper()}_STEPS"


def _fallback(
    kernel: Kernel, options: Options, words: dict[str, str], programme: Programme
) -> str:
    n, p, m = programme.sizes
    call = _programme_arguments(kernel, programme.tape)
    solve = "solve(&qp, inverse_factor, &answer)"
    if programme.factor.proximal > 0.0:
        solve = "solve_proximal(&qp, inverse_factor, &answer)"
    factor = [
        literal(x, options.real) for x in np.ravel(programme.factor.inverse).tolist()
    ]
    return template(
        "fallback.c",
        words
        | {
            "n_factor": str(n * n),
            "factor": ", ".join(factor),
            "programme_call": f"programme({', '.join(call)})",
            "solve": solve,
            "restart": _restart(n, p, m)
            if programme.restart
            else "        (void)next;\n",
        },
    )


def _programme_arguments(kernel: Kernel, tape: Tape) -> list[str]:
    wanted = len(tape.inputs)
    given = [pointer("in->", f) for f in kernel.inputs[:wanted]]
    return given + [f"qp.{name}" for name in FIELDS]


def _restart(n: int, p: int, m: int) -> str:
    """The network goes on from the solution."""
    text = ""
    parts = (("x", 0, n), ("lam", n, p), ("mu", n + p, m))
    for name, start, count in parts:
        if count:
            place = f"i + {start}U" if start else "i"
            text += (
                f"        for (i = 0U; i < {count}U; ++i) {{\n"
                f"            next[{place}] = answer.{name}[i];\n        }}\n"
            )
    return text


def _take(words: dict[str, str]) -> str:
    name = words["PREFIX"]
    return (
        f"    if ((status == {name}_OK) && (verdict != 0U)) {{\n"
        "        status = fall_back(in, next, output, &iterations);\n"
        f"        verdict |= {name}_FELL_BACK;\n    }}\n"
    )
