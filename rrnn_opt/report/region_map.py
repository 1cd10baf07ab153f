"""The picture of a region map: certified bounds over two joints."""

from __future__ import annotations

import io
import math
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.errors import DocumentError
from rrnn_opt.report.axes import INK
from rrnn_opt.report.files import write_bytes
from rrnn_opt.report.save import save

Array = NDArray[np.float64]
KIND = "rrnn_opt region map"
_PANELS = (
    ("share", "certified share of the volume [%]", 100.0),
    ("sigma", "smallest singular value of J, at least [m]", 1.0),
    ("rate", "rate alpha of V' <= -alpha V, at least [1/s]", 1.0),
)


def draw_region(document: dict[str, Any], path: str | Path) -> Path:
    """Write the PNG of a region map.

    Args:
        document: ``RegionMap.to_dict()``.
        path: file to write; it appears whole or not at all.

    Raises:
        DocumentError: the document is not a region map.
        OSError: the file cannot be written.
    """
    from matplotlib.figure import Figure

    try:
        if document["kind"] != KIND:
            raise ValueError(f"kind is '{document['kind']}'")
        tiles = _tiles(document["cells"])
        title, names = _words(document)
    except (KeyError, TypeError, ValueError) as error:
        raise DocumentError("region map", f"not readable ({error!r})") from error
    figure = Figure(figsize=(12.0, 3.9), layout="constrained")
    figure.suptitle(title, fontsize=10, color=INK)
    for axes, (key, label, factor) in zip(figure.subplots(1, 3), _PANELS, strict=True):
        _panel(axes, tiles, key, factor)
        axes.set_title(label, fontsize=9, loc="left", color=INK)
        axes.set_xlabel(names[0], fontsize=8)
        axes.set_ylabel(names[1], fontsize=8)
        axes.tick_params(labelsize=7)
    buffer = io.BytesIO()
    save(figure, buffer, format="png", dpi=110)
    return write_bytes(path, buffer.getvalue())


def _tiles(cells: list[dict[str, Any]]) -> dict[str, Array]:
    table: dict[str, Array] = {
        name: np.array([cell[name] for cell in cells], dtype=np.float64)
        for name in ("lower", "upper", "share", "sigma", "rate")
    }
    if not len(cells) or table["lower"].shape != (len(cells), 2):
        raise ValueError("a cell has two lower and two upper ends")
    return table


def percent(share: float) -> str:
    """A share in percent, never rounded up: all but a little is not 100 %."""
    return f"{math.floor(1e4 * float(share)) / 100:g} %"


def _words(document: dict[str, Any]) -> tuple[str, tuple[str, str]]:
    sigma = float(document["sigma"])
    title = (
        f"{document['robot']}: {percent(document['share'])} of the region certified,"
        f" sigma_min(J) >= {sigma:.3g} m, alpha >= {float(document['rate']):.3g} 1/s,"
        f" step <= {float(document['step']):.3g} s there"
    )
    first, second = (int(k) + 1 for k in document["joints"])
    return title, (f"joint {first} [rad]", f"joint {second} [rad]")


def _panel(axes: Any, tiles: dict[str, Array], key: str, factor: float) -> None:
    """Coloured tiles; what is not certified at all is hatched."""
    from matplotlib.collections import PatchCollection
    from matplotlib.patches import Rectangle

    size = tiles["upper"] - tiles["lower"]
    boxes = [
        Rectangle((x, y), w, h)
        for (x, y), (w, h) in zip(tiles["lower"], size, strict=True)
    ]
    known = tiles["share"] > 0.0
    for box in (b for b, k in zip(boxes, known, strict=True) if not k):
        box.set(facecolor="#f3e3e1", edgecolor="#c0392b", hatch="///", linewidth=0.3)
        axes.add_patch(box)
    chosen = [b for b, k in zip(boxes, known, strict=True) if k]
    patches = PatchCollection(chosen, edgecolor="white", linewidth=0.4)
    patches.set_array(factor * tiles[key][known])
    patches.set_clim(0.0, max(float((factor * tiles[key]).max()), 1e-12))
    axes.add_collection(patches)
    axes.set_xlim(tiles["lower"][:, 0].min(), tiles["upper"][:, 0].max())
    axes.set_ylim(tiles["lower"][:, 1].min(), tiles["upper"][:, 1].max())
    axes.figure.colorbar(patches, ax=axes).ax.tick_params(labelsize=7)
