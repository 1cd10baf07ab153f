"""The monitor of a package, in C."""

from __future__ import annotations

from rrnn_opt.embedding.kernel import Kernel
from rrnn_opt.embedding.render import pointer


def monitor_words(kernel: Kernel, words: dict[str, str]) -> dict[str, str]:
    """Words of ``<prefix>_monitor``: its arrays, the call, and what is active.

    Args:
        kernel: the functions.
        words: of ``render.common_words``.
    """
    bounds, rows = kernel.watched
    given = [pointer("state->", kernel.state)]
    given += [pointer("in->", f) for f in kernel.inputs] + ["&state->step_size"]
    results = [
        "&seen.merit",
        "&seen.merit_change",
        "&seen.residual",
        "&extent",
        "&size",
    ]
    results += ["below", "above", "&room"] * bool(bounds) + ["slack"] * bool(rows)
    return {
        "monitor_call": f"watch({', '.join(given + results)})",
        "monitor_arrays": _monitor_arrays(bounds, rows),
        "monitor_bounds": _monitor_bounds(words["PREFIX"]) * bool(bounds),
        "monitor_rows": _monitor_rows(words["PREFIX"]) * bool(rows),
    }


def _monitor_arrays(bounds: int, rows: int) -> str:
    text = f"    real_t below[{bounds}];\n    real_t above[{bounds}];\n" * bool(bounds)
    text += "    real_t room;\n" if bounds else "    const real_t room = RRNN_C(0.0);\n"
    text += f"    real_t slack[{rows}];\n" * bool(rows)
    return text + "    uint32_t i;\n" * bool(bounds or rows)


def _monitor_bounds(name: str) -> str:
    return (
        f"    for (i = 0U; i < (uint32_t){name}_N_BOUNDS; ++i) {{\n"
        "        if (above[i] <= state->tolerance) {\n"
        "            seen.bound[i] = 1;\n"
        f"            seen.verdict |= {name}_BOUND_ACTIVE;\n"
        "        } else if (below[i] <= state->tolerance) {\n"
        "            seen.bound[i] = -1;\n"
        f"            seen.verdict |= {name}_BOUND_ACTIVE;\n"
        "        } else {\n"
        "            seen.bound[i] = 0;\n"
        "        }\n    }\n"
    )


def _monitor_rows(name: str) -> str:
    return (
        f"    for (i = 0U; i < (uint32_t){name}_N_ROWS; ++i) {{\n"
        "        if (slack[i] <= state->tolerance) {\n"
        "            seen.row[i] = 1;\n"
        f"            seen.verdict |= {name}_ROW_ACTIVE;\n"
        "        }\n    }\n"
    )
