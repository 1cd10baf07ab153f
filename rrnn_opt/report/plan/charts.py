"""The small charts beside the picture; each draws into the axes it is given."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.report.axes import CURVES, LIMIT, dress
from rrnn_opt.report.plan.motion import Motion
from rrnn_opt.report.plan.palette import NEAREST

Array = NDArray[np.float64]

LONGEST = 14


def velocities(axes: Any, document: dict[str, Any], motion: Motion) -> None:
    """Joint velocities over time, each as a share of its own limit."""
    limits = np.asarray(document["robot"]["limits"]["velocity"], dtype=float)
    given = document["robot"].get("joint_names") or _numbered(len(limits))
    names = [_literal(name) for name in given]
    assert motion.qd is not None
    for k, share in enumerate((motion.qd / limits).T):
        axes.plot(
            motion.t, share, color=CURVES[k % len(CURVES)], lw=1.3, label=names[k]
        )
    for level in (-1.0, 1.0):
        axes.axhline(level, color=LIMIT, lw=1.0, ls=(0, (4, 3)))
    axes.set_ylim(-1.2, 1.2)
    dress(axes, "joint velocity / limit", "time [s]", motion.t)
    if len(names) <= 8:
        spacing = {"columnspacing": 1.0, "handlelength": 1.2}
        axes.legend(ncol=4, fontsize=6.5, frameon=False, loc="lower center", **spacing)
        axes.set_ylim(-1.75, 1.2)
        axes.set_yticks([-1, -0.5, 0, 0.5, 1])


def memory_cell(axes: Any, activity: Array) -> None:
    """Activity of the memory cell before each exploration."""
    order = np.arange(1.0, len(activity) + 1.0)
    axes.step(order, activity, where="mid", color=CURVES[3], lw=1.3)
    if len(order) <= 60:
        axes.plot(order, activity, "o", color=CURVES[3], ms=3.2)
    axes.axhline(0.5, color="#9aa1ad", lw=0.8, ls=(0, (2, 3)))
    axes.set_ylim(-0.06, 1.06)
    dress(axes, "memory-cell activity before each exploration", "exploration", order)
    axes.set_xlim(0.5, len(order) + 0.5)
    axes.xaxis.get_major_locator().set_params(integer=True, min_n_ticks=1)


def clearance(
    axes: Any, motion: Motion, distance: Array, proved: Any, closest: str = ""
) -> None:
    """Distance to the obstacles at the samples, with the proved bound.

    ``closest`` says in words between what the least of them is.
    """
    axes.plot(motion.t, 1e3 * distance, color=CURVES[0], lw=1.4, label="sampled")
    axes.axhline(0.0, color=LIMIT, lw=1.0, ls=(0, (4, 3)))
    if proved is not None:
        text = f"proved: at least {1e3 * proved:.3g} mm"
        axes.axhline(1e3 * proved, color=CURVES[2], lw=1.0, label=text)
    if closest:
        least = int(np.argmin(distance))
        place, label = (motion.t[least], 1e3 * distance[least]), _literal(closest, 60)
        axes.plot(*place, "o", mec=NEAREST, mfc="none", ms=7, mew=1.5, label=label)
    top = float(1e3 * distance.max())
    low, high = min(-0.08 * top, 1.1e3 * float(distance.min())), 1.5 * top
    axes.set_ylim(low, high + 1e-9)  # with room for the legend above the curve
    dress(axes, "clearance to obstacles [mm]", "time [s]", motion.t)
    axes.legend(fontsize=6.5, frameon=False, loc="upper right")


def _numbered(count: int) -> list[str]:
    return [f"q{k + 1}" for k in range(count)]


def _literal(name: object, longest: int = LONGEST) -> str:
    """A short name that matplotlib takes neither for a formula nor for hidden."""
    text = str(name).encode("utf-8", "replace").decode()
    text = (
        text
        if len(text) <= longest
        else text[: longest - 1] + "\N{HORIZONTAL ELLIPSIS}"
    )
    text = text.replace("$", r"\$")
    return f" {text}" if text.startswith("_") else text
