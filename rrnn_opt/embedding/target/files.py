"""Files that a package holds for bare Cortex-M boards."""

from __future__ import annotations

from rrnn_opt.embedding.options import Options
from rrnn_opt.embedding.render import template, verbatim
from rrnn_opt.embedding.vectors import step_of
from rrnn_opt.emit.c99 import literal

_AS_THEY_STAND = ("startup.c", "board.c", "board.h", "mps2.ld")
_FILLED_IN = ("test_target.c", "application.c")


def target_files(options: Options, words: dict[str, str]) -> dict[str, str]:
    """Start-up code, board support, a test and the least application, by path.

    They are in every package: a controller that is generated for the host today
    is tried on a board tomorrow.

    Args:
        options: step size and precision.
        words: those of ``render.common_words``.
    """
    own = words | {"step_size": literal(step_of(options), options.real)}
    files = {
        f"test/target/{name}": verbatim(f"target/{name}") for name in _AS_THEY_STAND
    }
    files |= {
        f"test/target/{name}": template(f"target/{name}", own) for name in _FILLED_IN
    }
    toolchain = "arm-none-eabi.cmake"
    return files | {f"cmake/{toolchain}": verbatim(f"target/{toolchain}")}
