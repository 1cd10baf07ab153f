"""A package as an FMU for co-simulation, FMI 3.0, with sources."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from xml.sax.saxutils import quoteattr

from rrnn_opt.embedding.kernel import Kernel
from rrnn_opt.embedding.options import Options
from rrnn_opt.embedding.render import plain, template
from rrnn_opt.embedding.vectors import step_of
from rrnn_opt.emit.c99 import literal

TICK = 0.001
"""Communication step that modelDescription.xml suggests, s."""


_TIME = "    {0U, offsetof(instance_t, time), 1U, 0},"


@dataclass(frozen=True)
class _Variable:
    """A floating-point variable of the FMU; ``member`` is where the C keeps it."""

    reference: int
    name: str
    member: str
    size: int
    causality: str
    start: float | None
    meaning: str


def fmu(
    kernel: Kernel, files: Mapping[str, str], options: Options, words: dict[str, str]
) -> dict[str, str]:
    """The folder ``fmu/``: zip its contents to have ``<prefix>.fmu``.

    Matrices are vectors, column by column.  One step of co-simulation is one
    call of ``step``, whatever its length; a call that is refused is discarded
    and its status is an output.

    Args:
        kernel: the functions.
        files: of the package, by path.
        options: prefix and precision.
        words: of ``render.common_words``.
    """
    name = options.prefix
    variables = _variables(kernel, options)
    sources = {
        f"fmu/sources/{path.rpartition('/')[2]}": text
        for path, text in files.items()
        if re.fullmatch(rf"(include|src)/{name}(_math|_qp)?\.[ch]", path)
    }
    code = _code(variables, options, words)
    return sources | {
        "fmu/modelDescription.xml": _description(variables, options, words),
        "fmu/sources/buildDescription.xml": _build(options),
        f"fmu/sources/{name}_fmu.c": code,
    }


def _variables(kernel: Kernel, options: Options) -> list[_Variable]:
    rows: list[tuple[str, str, int, str, float | None, str]] = [
        ("step_size", "param.step_size", 1, "parameter", step_of(options), "[s]"),
        ("tolerance", "param.tolerance", 1, "parameter", options.tolerance, "[1]"),
    ]
    for f in kernel.inputs:
        said = f"{plain(f.meaning)} [{plain(f.unit)}]"
        rows.append((f.name, f"in.{f.name}", f.size, "input", 0.0, said))
    out = kernel.output
    said = f"{plain(out.meaning)} [{plain(out.unit)}]"
    rows.append((out.name, f"out.{out.name}", out.size, "output", None, said))
    for name in ("residual", "merit", "merit_change"):
        rows.append((f"out.{name}", f"out.{name}", 1, "output", None, "see the header"))
    return [_Variable(k, *row) for k, row in enumerate(rows, start=1)]


def _code(variables: list[_Variable], options: Options, words: dict[str, str]) -> str:
    table = [
        f"    {{{v.reference}U, offsetof(instance_t, {v.member}), {v.size}U,"
        f" {int(v.causality != 'output')}}},"
        for v in variables
    ]
    last = len(variables)
    own = {
        "other": "REFUSED(fmi3SetFloat64)\n"
        if options.single
        else "REFUSED(fmi3GetFloat32)\nREFUSED(fmi3SetFloat32)\n",
        "table": "\n".join(table if options.single else [_TIME, *table]),
        "float": "Float32" if options.single else "Float64",
        "step_number": literal(step_of(options), options.real),
        "vr_status": str(last + 1),
        "vr_verdict": str(last + 2),
        "independent": template("fmu_time.txt", words) if options.single else "",
    }
    return template("fmu.txt", words | own)


def _description(
    variables: list[_Variable], options: Options, words: dict[str, str]
) -> str:
    kind = "Float32" if options.single else "Float64"
    last = len(variables)
    rows = [_row(v, kind) for v in variables]
    outputs = [v.reference for v in variables if v.causality == "output"]
    counted = (
        ("out.status", "status of the last call"),
        ("out.verdict", "verdict bits"),
    )
    for k, (name, meaning) in enumerate(counted, start=last + 1):
        outputs.append(k)
        rows.append(
            f'    <UInt32 name="{name}" valueReference="{k}" causality="output"'
            f' variability="discrete" description="{meaning}"/>'
        )
    return template(
        "modelDescription.txt",
        words
        | {
            "rows": "\n".join(rows),
            "outputs": "\n".join(
                f'    <{kind} valueReference="{k}"/>'
                for kind in ("Output", "InitialUnknown")
                for k in outputs
            ),
            "tick": repr(TICK),
            "title_attribute": quoteattr(words["title"]),
        },
    )


def _row(v: _Variable, kind: str) -> str:
    fixed = v.causality == "parameter"
    words = [
        f"    <{kind} name={quoteattr(v.name)}",
        f'valueReference="{v.reference}"',
        f'causality="{v.causality}"',
        f'variability="{"fixed" if fixed else "discrete"}"',
        f"description={quoteattr(v.meaning)}",
    ]
    if v.start is not None:
        words.append(f'start="{" ".join([repr(v.start)] * v.size)}"')
    text = " ".join(words)
    if v.size == 1:
        return f"{text}/>"
    return f'{text}>\n      <Dimension start="{v.size}"/>\n    </{kind}>'


def _build(options: Options) -> str:
    name = options.prefix
    return (
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        '<fmiBuildDescription fmiVersion="3.0">\n'
        f'  <BuildConfiguration modelIdentifier="{name}">\n'
        '    <SourceFileSet language="C99" compilerOptions="-ffp-contract=off">\n'
        f'      <SourceFile name="{name}.c"/>\n'
        f'      <SourceFile name="{name}_fmu.c"/>\n'
        "    </SourceFileSet>\n"
        "  </BuildConfiguration>\n"
        "</fmiBuildDescription>\n"
    )
