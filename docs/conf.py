"""Sphinx settings of the documentation site (``make docs``)."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1]))

project = "rrnn_opt"
copyright = "2026, The rrnn_opt authors"
highlight_language = "none"
author = "The rrnn_opt authors"
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
html_theme = "furo"
html_title = "rrnn_opt"
html_copy_source = False
html_static_path = ["_static"]
html_css_files = ["tables.css"]
exclude_patterns = ["_build"]
suppress_warnings = ["config.cache", "ref.python"]
myst_enable_extensions = ["deflist"]
myst_heading_anchors = 3
autodoc_member_order = "bysource"
autodoc_typehints = "description"
autodoc_class_signature = "separated"
autodoc_default_options = {
    "members": True,
    "show-inheritance": True,
}


def _plain(
    app: object, what: str, name: str, obj: object, options: object, lines: list[str]
) -> None:
    """Indented equations are literal, and ``|x|`` is a norm, not a substitution."""
    made: list[str] = []
    literal, before = False, ""
    for line in lines:
        indented = line.startswith("    ")
        if line.strip():
            opens = indented and not literal and made and not made[-1].strip()
            if opens and before[:1] not in ("", " ", ":", "."):
                made += ["::", ""]
                literal = True
            elif not indented:
                literal = False
            before = line
        made.append(line if literal else line.replace("|", r"\|"))
    lines[:] = made


def setup(app: Any) -> None:
    """Register the one hook."""
    app.connect("autodoc-process-docstring", _plain, priority=900)
