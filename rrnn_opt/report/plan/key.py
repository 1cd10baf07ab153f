"""What the colours of a picture mean, in two lines under the scene."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from rrnn_opt.report.plan.drawing import Drawing
from rrnn_opt.report.plan.palette import (
    END,
    NEAREST,
    OBSTACLE,
    START,
    TARGET,
    TREES,
    time_colours,
)

NOTE: dict[str, Any] = {"fontsize": 8, "color": "#5b6270", "parse_math": False}
ROWS = (0.033, 0.010)


def draw_key(figure: Any, drawing: Drawing) -> None:
    """Write the key into the lower edge of a figure."""
    x = _entries(figure, ROWS[0], _solid(drawing))
    if drawing.motion.moves:
        bar = figure.add_axes((x, ROWS[0] + 0.002, 0.07, 0.011))
        bar.imshow(time_colours(64)[None, :, :3], aspect="auto")
        bar.set_axis_off()
        figure.text(x + 0.076, ROWS[0], "time along the tip path", **NOTE)
    x = _entries(figure, ROWS[1], _searched(drawing))
    if drawing.missing:
        figure.text(x, ROWS[1], "not drawn: " + _some(drawing.missing), **NOTE)


def page_key(drawing: Drawing) -> list[tuple[str, str]]:
    """Colour and meaning of what the 3D scene of a page shows."""
    entries = [entry for entry in _solid(drawing) if entry[0] not in (START, OBSTACLE)]
    if drawing.shapes:
        entries.append((OBSTACLE, "obstacles"))
    return [*entries, *_searched(drawing)]


def nearest_approach(drawing: Drawing) -> str:
    """The closest approach in words; empty without one."""
    near = drawing.closest
    if near is None:
        return ""
    what = f"{near.link or 'robot'} to {drawing.shapes[near.obstacle].name}"
    return f"{1e3 * near.distance:.3g} mm, {_short(what)}"


def _solid(drawing: Drawing) -> Iterator[tuple[str, str]]:
    yield START, "start"
    if drawing.motion.moves:
        yield END, "end"
    if len(drawing.targets):
        yield TARGET, "target"
    if drawing.solids:
        yield OBSTACLE, "obstacles, cut at the frame"


def _searched(drawing: Drawing) -> Iterator[tuple[str, str]]:
    for side, pieces in drawing.traces.items():
        if len(pieces):
            yield TREES[side], f"tool traces of the {side}'s tree"
    if drawing.closest is not None:
        yield NEAREST, "closest approach (sampled): " + nearest_approach(drawing)


def _entries(figure: Any, y: float, entries: Iterator[tuple[str, str]]) -> float:
    """One line of the key; returns where it ends."""
    x = 0.02
    for colour, text in entries:
        figure.text(x, y - 0.002, "\N{BLACK CIRCLE}", fontsize=10, color=colour)
        figure.text(x + 0.012, y, text, **NOTE)
        x += 0.03 + 0.0052 * len(text)
    return x


def _short(text: str, most: int = 48) -> str:
    return text if len(text) <= most else text[: most - 1] + "\N{HORIZONTAL ELLIPSIS}"


def _some(names: list[str]) -> str:
    """The first names, and how many more there are."""
    more = len(names) - 2
    return ", ".join(names[:2]) + (f" and {more} more" if more > 0 else "")
