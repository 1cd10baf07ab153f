"""The tests that a package carries: self-test, host test, their vectors."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from importlib import metadata

from rrnn_opt.embedding.kernel import Kernel
from rrnn_opt.embedding.options import Options
from rrnn_opt.embedding.render import array, template, value
from rrnn_opt.embedding.vectors import Vector, step_of
from rrnn_opt.emit.c99 import literal


def vectors_header(
    kernel: Kernel,
    vectors: Sequence[Vector],
    words: dict[str, str],
    options: Options,
    name: str,
) -> str:
    """A header of reference vectors: ``<prefix>_<name>``, their number in capitals."""
    rows = []
    for v in vectors:
        fields = zip(kernel.inputs, v.inputs, strict=True)
        inputs = ", ".join(value(x, options.real, f) for f, x in fields)
        parts = [
            array(v.state, options.real),
            f"{{{inputs or literal(0.0, options.real)}}}",
            array(v.next, options.real),
            array(v.output, options.real),
            literal(v.merit, options.real),
        ]
        rows.append("    {" + ",\n     ".join(parts) + "},")
    own = {
        "cases": str(len(vectors)),
        "vectors": "\n".join(rows),
        "name": name,
        "NAME": name.upper(),
        "kind": name.removesuffix("s"),
    }
    return template("vectors.h", words | own)


def selftest(words: dict[str, str], options: Options, close: float) -> str:
    """src/<prefix>_selftest.c."""
    own = {"compare": _compare(words, options, close), "step_size": _step(options)}
    return template("selftest.c", words | own)


def host_test(
    kernel: Kernel, words: dict[str, str], options: Options, close: float
) -> str:
    """test/test_host.c."""
    return template(
        "test_host.c",
        words
        | {
            "casadi": metadata.version("casadi"),
            "compare": _compare(words, options, close),
            "step_size": _step(options),
            "claim": "bit for bit" if options.exact else f"within {close:g}",
            "poison": "".join(_poison(kernel, words)),
        },
    )


def _step(options: Options) -> str:
    return literal(step_of(options), options.real)


def _compare(words: dict[str, str], options: Options, close: float) -> str:
    if options.exact:
        return "    return (got == want) ? 0 : 1;\n"
    zero, one = words["zero"], words["one"]
    real = f"{options.prefix}_real_t"
    return (
        f"    const {real} size = (want < {zero}) ? -want : want;\n"
        f"    const {real} gap = (got < want) ? (want - got) : (got - want);\n"
        f"    const {real} scale = (size > {one}) ? size : {one};\n"
        f"    return (gap <= ({literal(close, options.real)} * scale)) ? 0 : 1;\n"
    )


def _poison(kernel: Kernel, words: dict[str, str]) -> Iterator[str]:
    """Lines that give every input field a NaN, an infinity, a huge number."""
    prefix, PREFIX = words["prefix"], words["PREFIX"]
    cases = [("NAN", "NOT_FINITE"), ("INFINITY", "NOT_FINITE")]
    cases.append((f"(4 * {PREFIX}_LARGEST)", "OUT_OF_RANGE"))
    for field in kernel.inputs:
        place = f"in.{field.name}" + ("" if field.size == 1 else f"[{field.size - 1}]")
        for bad, status in cases:
            yield f"    {place} = (real_t){bad};\n"
            yield (
                f"    bad += ({prefix}_step(&state, &in, &out) != {PREFIX}_{status})"
                " ? 1 : 0;\n"
            )
            yield (
                f"    bad += ({prefix}_monitor(&state, &in, &monitor)"
                f" != {PREFIX}_{status}) ? 1 : 0;\n"
            )
        yield f"    in = {prefix}_cases[0].in;\n"
