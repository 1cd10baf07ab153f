"""The page of a plan: one HTML file that opens offline.

Scene on the left (viser's viewer in a frame, or the picture where viser is
not installed), charts and a table on the right.  The page forbids itself any
network request, and every string of the document is escaped.
"""

from __future__ import annotations

import base64
import html
import io
from importlib import resources
from pathlib import Path
from string import Template
from typing import Any

from rrnn_opt.report.files import write_text
from rrnn_opt.report.plan.drawing import Drawing, drawing_of
from rrnn_opt.report.plan.key import nearest_approach, page_key
from rrnn_opt.report.plan.palette import END
from rrnn_opt.report.plan.picture import chart_list, picture
from rrnn_opt.report.plan.viewer import INSTALL, scene_html
from rrnn_opt.report.save import save

WAITING = (
    '<p class="wait">The scene is being unpacked; it needs WebGL. '
    "Without it, rrnn plan --out writes a picture, plan.png.</p>"
)


def write_page(document: dict[str, Any], path: str | Path) -> None:
    """Write the HTML page of a plan result.

    Args:
        document: plan result.
        path: file to write; it appears whole or not at all.

    Raises:
        DocumentError: the document is not a plan result.
        OSError: the file cannot be written.
    """
    write_text(path, page(document))


def page(document: dict[str, Any], drawing: Drawing | None = None) -> str:
    """The HTML page of a plan result.

    Args:
        document: plan result.
        drawing: of that document, where the caller has it already.

    Raises:
        DocumentError: the document is not a plan result.
    """
    drawing = drawing_of(document) if drawing is None else drawing
    robot = str(document["robot"].get("name", "robot"))
    template = resources.files("rrnn_opt.report.plan").joinpath("page.html")
    return Template(template.read_text("utf-8")).substitute(
        title=html.escape(f"{robot}: {document.get('status', 'plan')}"),
        robot=html.escape(robot),
        status=html.escape(str(document.get("status", ""))),
        tone="good" if document.get("status") == "solved" else "bad",
        message=html.escape(str(document.get("message", ""))),
        scene=_scene(document, drawing),
        charts="".join(_svg(panel) for panel in chart_list(document, drawing)),
        rows=_rows(document, drawing),
    )


def _scene(document: dict[str, Any], drawing: Drawing) -> str:
    inner = scene_html(drawing)
    if inner is not None:
        source = html.escape(inner, quote=True)
        return (
            f'{WAITING}<iframe title="scene" srcdoc="{source}"></iframe>{_key(drawing)}'
        )
    data = base64.b64encode(picture(document, drawing)).decode("ascii")
    return (
        f'<figure><img alt="the motion" src="data:image/png;base64,{data}">'
        f"<figcaption>For the moving scene: <code>{INSTALL}</code></figcaption>"
        "</figure>"
    )


def _key(drawing: Drawing) -> str:
    """What the colours of the scene mean."""
    entries = "".join(
        f'<span><i style="background:{colour}"></i>{html.escape(words)}</span>'
        for colour, words in [(END, "robot; pale: its end"), *page_key(drawing)]
        if words != "end"
    )
    return f'<p class="key">{entries}</p>'


def _svg(panel: Any) -> str:
    """One chart as inline SVG."""
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    figure = Figure(figsize=(4.6, 2.35), layout="constrained")
    figure.patch.set_alpha(0.0)
    panel(figure.add_subplot())
    text = io.StringIO()
    with rc_context({"svg.hashsalt": "rrnn_opt"}):
        save(figure, text, format="svg", metadata={"Date": None, "Creator": None})
    drawn = text.getvalue()
    return f"<figure>{drawn[drawn.index('<svg') :]}</figure>"


def _rows(document: dict[str, Any], drawing: Drawing) -> str:
    """The summary table: certificate, statistics, versions."""
    parts = []
    plain = {key: document.get(key) for key in ("planner", "seed")}
    plain["duration [s]"] = (document.get("trajectory") or {}).get("duration")
    plain["closest approach (sampled)"] = nearest_approach(drawing) or None
    groups = [("run", plain)] + [
        (key, document.get(key) or {}) for key in ("certificate", "stats", "versions")
    ]
    for title, values in groups:
        parts.append(
            f'<tr class="group"><th colspan="2">{html.escape(title)}</th></tr>'
        )
        for key, value in values.items():
            if value is None or isinstance(value, dict | list):
                continue
            parts.append(
                f"<tr><th>{html.escape(str(key).replace('_', ' '))}</th>"
                f"<td>{html.escape(_shown(value))}</td></tr>"
            )
    return "\n".join(parts)


def _shown(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
