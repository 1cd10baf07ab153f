"""The same C in the layouts that other tools expect."""

from __future__ import annotations

import re
from collections.abc import Mapping

from rrnn_opt.embedding.options import Options
from rrnn_opt.embedding.render import template
from rrnn_opt.embedding.vectors import step_of
from rrnn_opt.emit.c99 import literal


def arduino(
    files: Mapping[str, str], options: Options, words: dict[str, str]
) -> dict[str, str]:
    """An Arduino library: the sources flat in ``src/``, and a sketch.

    The sketch runs the self-test once and the controller at 1 kHz; what the
    robot measures is left to fill in.

    Args:
        files: of the package, by path.
        options: the prefix among them.
        words: of ``render.common_words``.
    """
    name = options.prefix
    library = f"arduino/{name}"
    kept = {
        f"{library}/src/{path.rpartition('/')[2]}": text
        for path, text in files.items()
        if re.match(rf"(include|src)/{name}", path)
    }
    own = words | {
        "sentence": words["title"].replace("=", " "),
        "step_number": literal(step_of(options), options.real),
    }
    sketch = f"{library}/examples/{name}_loop/{name}_loop.ino"
    return kept | {
        f"{library}/library.properties": template("library.txt", own),
        sketch: template("sketch.txt", own),
    }
