"""The pages of a package for people."""

from __future__ import annotations

from rrnn_opt.embedding.kernel import Kernel
from rrnn_opt.embedding.options import Options
from rrnn_opt.embedding.render import EXTENT, plain, template
from rrnn_opt.embedding.vectors import HOST_CASES
from rrnn_opt.emit.c99 import library_calls


def readme(
    kernel: Kernel, words: dict[str, str], options: Options, close: float
) -> str:
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
            "angle": f"{EXTENT[options.real]:g}",
            "cases": str(HOST_CASES),
            "tolerance_text": f"{close:g}",
        },
    )
