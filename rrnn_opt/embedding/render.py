"""Filling in templates, and how a field is written in C."""

from __future__ import annotations

import re
from importlib import metadata, resources
from string import Template

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.embedding.kernel import Field, Kernel
from rrnn_opt.embedding.options import Options
from rrnn_opt.embedding.programme import Programme
from rrnn_opt.emit.c99 import literal
from rrnn_opt.emit.prologue import Real

EXTENT = {"double": 2.0**30, "float": 2.0**15}
"""Norm of the inputs that is still accepted; own sine and cosine end there."""


def template(name: str, words: dict[str, str]) -> str:
    """One template with all its words filled in."""
    return Template(verbatim(name)).substitute(words)


def verbatim(name: str) -> str:
    """One template as it stands."""
    folder = resources.files("rrnn_opt.embedding") / "templates"
    return (folder / name).read_text("utf-8")


def common_words(
    kernel: Kernel, options: Options, programme: Programme | None, longest: float | None
) -> dict[str, str]:
    """Words that every template may use.

    Args:
        kernel: the functions.
        options: what was asked for.
        programme: of the fallback; None without.
        longest: Euler step, s, up to which a bound is known; None without.
    """
    prefix, real = options.prefix, options.real
    bounds, rows = kernel.watched
    return {
        "prefix": prefix,
        "PREFIX": prefix.upper(),
        "title": plain(kernel.dynamics.name),
        "version": metadata.version("rrnn_opt"),
        "hash": kernel.tape.fingerprint,
        "real": real,
        "steps": str(options.steps),
        "step_macro": _step_macros(options, longest),
        "step_text": f"{prefix.upper()}_STEP_SIZE"
        if options.step_size is not None
        else "/* step size [s] */",
        "tolerance": literal(options.tolerance, real),
        "extent": literal(EXTENT[real], real),
        "has_fallback": "1" if programme is not None else "0",
        "n_state": str(kernel.state.size),
        "n_output": str(kernel.output.size),
        "n_bounds": str(bounds),
        "n_rows": str(rows),
        "room_bounds": str(max(bounds, 1)),
        "room_rows": str(max(rows, 1)),
        "zero": literal(0.0, real),
        "one": literal(1.0, real),
        "never": literal(float(np.finfo(np.float32).max), real),
        "f": "f" if options.single else "",
        "state_access": access("state->", kernel.state),
        "output_access": access("out->", kernel.output),
        "state_ref": access("state.", kernel.state),
        "output_ref": access("out.", kernel.output),
    }


def plain(text: str) -> str:
    """Text that ends no comment, starts no directive and stays on one line."""
    line = re.sub(r"\s+", " ", text).strip()
    ascii_line = line.encode("ascii", "replace").decode()
    return ascii_line.replace("*/", "* /").replace("/*", "/ *").replace("\\", "/")


def declaration(field: Field, real: str) -> str:
    """A field as the member of a struct."""
    size = "" if field.size == 1 else f"[{field.size}]"
    shape = f" {field.shape[0]}x{field.shape[1]}," if field.shape[1] > 1 else ""
    text = f"{plain(field.meaning) or field.name}{',' * bool(shape)}{shape.rstrip(',')}"
    return f"    {real} {field.name}{size}; /* {text} [{plain(field.unit)}] */"


def pointer(owner: str, field: Field) -> str:
    """A field as the argument of a function that takes an array."""
    return f"{owner}{field.name}" if field.size > 1 else f"&{owner}{field.name}"


def access(owner: str, field: Field) -> str:
    """An expression that can be indexed, also for a scalar field."""
    return f"{owner}{field.name}" if field.size > 1 else f"(&{owner}{field.name})"


def array(values: NDArray[np.float64], real: Real) -> str:
    """Numbers as the initialiser of an array."""
    return "{" + ", ".join(literal(x, real) for x in values.tolist()) + "}"


def value(values: NDArray[np.float64], real: Real, field: Field) -> str:
    """Numbers as the initialiser of a field."""
    return array(values, real) if field.size > 1 else literal(values.item(), real)


def _step_macros(options: Options, longest: float | None) -> str:
    name, text = options.prefix.upper(), ""
    if options.step_size is not None:
        step = literal(options.step_size, options.real)
        text += "\n/* Euler step that was asked for [s]. */\n"
        text += f"#define {name}_STEP_SIZE {step}\n"
    if longest is not None:
        bound = literal(longest, options.real)
        text += (
            "\n/* Euler step up to which no step goes away from a solution [s]. */\n"
        )
        text += f"#define {name}_LONGEST_STEP {bound}\n"
    return text
