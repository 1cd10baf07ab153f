"""Filling in the templates of a package."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from importlib import metadata, resources
from string import Template

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.embedding.kernel import Field, Kernel
from rrnn_opt.embedding.vectors import CASES, Vector
from rrnn_opt.emit import c_function, prologue
from rrnn_opt.emit.c99 import library_calls, literal
from rrnn_opt.emit.prologue import Real

_LARGEST = {"double": "DBL_MAX", "float": "FLT_MAX"}
_ANGLE = {"double": "2^30", "float": "2^15"}


def template(name: str, words: dict[str, str]) -> str:
    """One template with all its words filled in."""
    folder = resources.files("rrnn_opt.embedding") / "templates"
    return Template((folder / name).read_text("utf-8")).substitute(words)


def licence() -> str:
    """Text of the licence of a package."""
    folder = resources.files("rrnn_opt.embedding") / "templates"
    return (folder / "APACHE-2.0.md").read_text("utf-8")


def common_words(
    kernel: Kernel, *, prefix: str, real: Real, steps: int, step_size: float | None
) -> dict[str, str]:
    """Words that every template may use."""
    step = "" if step_size is None else literal(step_size, real)
    name = f"{prefix.upper()}_STEP_SIZE"
    macro = f"\n/* Euler step that was asked for [s]. */\n#define {name} {step}\n"
    return {
        "prefix": prefix,
        "PREFIX": prefix.upper(),
        "title": plain(kernel.dynamics.name),
        "version": metadata.version("rrnn_opt"),
        "hash": kernel.tape.fingerprint,
        "real": real,
        "steps": str(steps),
        "step_macro": macro if step else "",
        "step_text": name if step else "/* step size [s] */",
        "n_state": str(kernel.state.size),
        "n_output": str(kernel.output.size),
    }


def header(kernel: Kernel, words: dict[str, str]) -> str:
    """include/<prefix>.h."""
    real = f"{words['prefix']}_real_t"
    return template(
        "header.h",
        words
        | {
            "state_fields": _declaration(kernel.state, real),
            "in_fields": "\n".join(_declaration(f, real) for f in kernel.inputs)
            or f"    {real} unused; /* the network has no parameters */",
            "out_fields": _declaration(kernel.output, real),
        },
    )


def source(kernel: Kernel, words: dict[str, str], real: Real) -> str:
    """src/<prefix>.c."""
    prefix, n = words["prefix"], kernel.bounds
    call = [_read("x", kernel.state, local=True)]
    call += [_read(f"in->{f.name}", f) for f in kernel.inputs]
    call += ["&state->step_size", "next", "output", "residual"]
    call += ["lower", "upper"] * (n > 0)
    checks = [_finite(f"state->{kernel.state.name}", kernel.state)]
    checks += [_finite(f"in->{f.name}", f) for f in kernel.inputs]
    empty = (
        f"    for (i = 0U; i < {n}U; ++i) {{\n"
        "        if (!(lower[i] <= upper[i])) {\n"
        f"            return {words['PREFIX']}_EMPTY_LIMITS;\n"
        "        }\n"
        "    }\n"
    )
    return template(
        "source.c",
        words
        | {
            "prologue": prologue(real, compact=True),
            "kernel": c_function(
                kernel.tape, f"{prefix}_kernel", real=real, compact=True
            ),
            "kernel_call": f"{prefix}_kernel({', '.join(call)})",
            "largest": _LARGEST[real],
            "bound_arrays": f"    real_t lower[{n}];\n    real_t upper[{n}];\n"
            * (n > 0),
            "bound_checks": empty * (n > 0),
            "finite_checks": "\n        || ".join(checks),
            "unused": "" if kernel.inputs else "    (void)in;\n",
            "state_access": _access("state", kernel.state),
            "output_access": _access("out", kernel.output),
        },
    )


def host_test(
    kernel: Kernel,
    vectors: Sequence[Vector],
    words: dict[str, str],
    real: Real,
    step_size: float,
    tolerance: float,
) -> str:
    """test/test_host.c."""
    rows = []
    for v in vectors:
        fields = zip(kernel.inputs, v.inputs, strict=True)
        inputs = ", ".join(_value(x, real, f) for f, x in fields) or literal(0.0, real)
        parts = [_array(v.state, real), f"{{{inputs}}}"]
        parts += [_array(v.next, real), _array(v.output, real)]
        rows.append("    {" + ",\n     ".join(parts) + "},")
    return template(
        "test_host.c",
        words
        | {
            "casadi": metadata.version("casadi"),
            "cases": str(len(vectors)),
            "tolerance": literal(tolerance, real),
            "step_size": literal(step_size, real),
            "vectors": "\n".join(rows),
            "zero": literal(0.0, real),
            "one": literal(1.0, real),
            "f": "f" if real == "float" else "",
            "state_ref": _read(f"state.{kernel.state.name}", kernel.state),
            "output_ref": _read("out.output", kernel.output),
            "poison": "".join(_poison(kernel, words)),
        },
    )


def readme(kernel: Kernel, words: dict[str, str], real: Real, tolerance: float) -> str:
    """README.md."""
    form = kernel.dynamics.formulation
    fields = [("state", kernel.state), *(("in", f) for f in kernel.inputs)]
    fields.append(("out", kernel.output))
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
            "library": ", ".join(library_calls(kernel.tape)) or "none but sqrt, fabs",
            "angle": _ANGLE[real],
            "cases": str(CASES),
            "tolerance": f"{tolerance:g}",
        },
    )


def plain(text: str) -> str:
    """Text that ends no comment, starts no directive and stays on one line."""
    line = re.sub(r"\s+", " ", text).strip()
    ascii_line = line.encode("ascii", "replace").decode()
    return ascii_line.replace("*/", "* /").replace("/*", "/ *").replace("\\", "/")


def _declaration(field: Field, real: str) -> str:
    size = "" if field.size == 1 else f"[{field.size}]"
    shape = f" {field.shape[0]}x{field.shape[1]}," if field.shape[1] > 1 else ""
    text = f"{plain(field.meaning) or field.name}{',' * bool(shape)}{shape.rstrip(',')}"
    return f"    {real} {field.name}{size}; /* {text} [{plain(field.unit)}] */"


def _read(access: str, field: Field, *, local: bool = False) -> str:
    return access if field.size > 1 or local else f"&{access}"


def _access(struct: str, field: Field) -> str:
    """An expression that can be indexed, also for a scalar field."""
    access = f"{struct}->{field.name}"
    return access if field.size > 1 else f"(&{access})"


def _finite(access: str, field: Field) -> str:
    return f"(all_finite({_read(access, field)}, {field.size}U) == 0)"


def _array(values: NDArray[np.float64], real: Real) -> str:
    return "{" + ", ".join(literal(x, real) for x in values.tolist()) + "}"


def _value(values: NDArray[np.float64], real: Real, field: Field) -> str:
    return _array(values, real) if field.size > 1 else literal(values.item(), real)


def _poison(kernel: Kernel, words: dict[str, str]) -> Iterator[str]:
    """Lines that give every input field a NaN, then an infinity."""
    prefix, PREFIX = words["prefix"], words["PREFIX"]
    for field in kernel.inputs:
        place = f"in.{field.name}" + ("" if field.size == 1 else f"[{field.size - 1}]")
        for value in ("NAN", "INFINITY"):
            yield f"    {place} = (real_t){value};\n"
            yield (
                f"    bad += ({prefix}_step(&state, &in, &out) != {PREFIX}_NOT_FINITE)"
                " ? 1 : 0;\n"
            )
        yield "    in = vectors[0].in;\n"
