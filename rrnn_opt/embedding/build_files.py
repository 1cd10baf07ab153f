"""How a package is built on a host, and called from Python there."""

from __future__ import annotations

from rrnn_opt.embedding.kernel import Kernel
from rrnn_opt.embedding.options import Options
from rrnn_opt.embedding.render import template


def build_files(
    kernel: Kernel, options: Options, words: dict[str, str]
) -> dict[str, str]:
    """CMakeLists.txt and the Python module.

    Args:
        kernel: the functions.
        options: what was asked for.
        words: of ``render.common_words``.
    """
    sizes = [(f.name, f.size) for f in kernel.inputs]
    step = options.step_size
    own = {
        "contract": "fast" if options.fused else "off",
        "ctype": "c_float" if options.single else "c_double",
        "inputs": repr(tuple(sizes)).replace("'", '"'),
        "example": ", ".join(f"{name}=.." for name, _ in sizes),
        "default_step": "" if step is None else f" = {step!r}",
        "tolerance_number": repr(options.tolerance),
    }
    return {
        "CMakeLists.txt": template("CMakeLists.txt", words | own),
        f"python/{options.prefix}.py": template("wrapper.txt", words | own),
    }
