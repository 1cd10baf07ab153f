"""The picture of a tracked curve: error, curve and velocities."""

from __future__ import annotations

from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.report.axes import CURVES, LIMIT, dress
from rrnn_opt.report.save import save

Array = NDArray[np.float64]


def draw_tracking(
    file: BinaryIO, *, t: Array, reference: Array, tip: Array, share: Array, title: str
) -> None:
    """Write a PNG.

    Args:
        file: where to.
        t: s, (n,).
        reference: where the tip should be, (n, 3), m.
        tip: where it was, (n, 3), m.
        share: joint velocities over their limits, (n, nv), 1.
        title: of the picture.
    """
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11.0, 4.0), dpi=130, layout="constrained")
    figure.suptitle(title, fontsize=11, x=0.01, ha="left", weight="bold")
    curve, error, velocity = figure.subplots(1, 3)
    _curve(curve, reference, tip)
    error.plot(
        t, 1e3 * np.linalg.norm(reference - tip, axis=1), color=CURVES[3], lw=1.2
    )
    dress(error, "tip error [mm]", "time [s]", t)
    for k, column in enumerate(share.T):
        velocity.plot(t, column, color=CURVES[k % len(CURVES)], lw=1.0)
    for level in (-1.0, 1.0):
        velocity.axhline(level, color=LIMIT, lw=1.0, ls=(0, (4, 3)))
    dress(velocity, "joint velocity / limit", "time [s]", t)
    save(figure, file, format="png")


def _curve(axes: Any, reference: Array, tip: Array) -> None:
    """Both curves in the plane in which the reference extends most."""
    first, second = sorted(np.argsort(np.ptp(reference, axis=0))[-2:])
    axes.plot(reference[:, first], reference[:, second], color="#9aa1ad", lw=3.0)
    axes.plot(tip[:, first], tip[:, second], color=CURVES[0], lw=1.2)
    axes.set_aspect("equal", adjustable="datalim")
    names = "xyz"
    dress(axes, "curve (grey) and tip [m]", f"{names[first]} [m]", reference[:0, 0])
    axes.set_ylabel(f"{names[second]} [m]", fontsize=7.5)
