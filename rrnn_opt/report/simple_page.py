"""A page of Markdown as one HTML file: headings, paragraphs, lists, tables, pictures.

Only the Markdown that this package's own reports use; pictures are put inside, so
that the file can be sent.
"""

from __future__ import annotations

import base64
import html
import re
from collections.abc import Iterator
from pathlib import Path

_VIEWPORT = "<meta name='viewport' content='width=device-width, initial-scale=1'>"
_STYLE = """
body{font:15px/1.5 system-ui,sans-serif;color:#2b2f38;max-width:1200px;margin:2em auto;
padding:0 1em}table{border-collapse:collapse;font-size:13px;margin:1em 0;display:block;
overflow-x:auto}th,td{border-bottom:1px solid #e3e6ec;padding:3px 9px;text-align:left;
font-variant-numeric:tabular-nums}th{background:#f4f6f9}td.short{white-space:nowrap}img{max-width:100%}
code{background:#f4f6f9;padding:1px 4px}
"""
_SHORT = 24
"""Letters of a cell that is not broken into lines."""


def html_page(markdown: str, *, title: str, folder: Path) -> str:
    """The page as HTML.

    Args:
        markdown: the text.
        title: of the window.
        folder: where relative pictures stand.
    """
    body = "\n".join(_blocks(markdown, folder))
    head = f"<meta charset='utf-8'>{_VIEWPORT}<title>{html.escape(title)}</title>"
    return (
        f"<!doctype html><html lang='en'><head>{head}<style>{_STYLE}</style></head>"
        + (f"<body>\n{body}\n</body></html>\n")
    )


def _blocks(markdown: str, folder: Path) -> Iterator[str]:
    for block in re.split(r"\n{2,}", markdown.strip()):
        lines = block.splitlines()
        heading = re.match(r"(#+) (.*)", lines[0])
        if heading:
            level = len(heading[1])
            yield f"<h{level}>{_inline(heading[2], folder)}</h{level}>"
            lines = lines[1:]
        if not lines:
            continue
        if lines[0].startswith("|"):
            yield _table(lines, folder)
        elif lines[0].startswith(("- ", "* ")):
            joined = re.sub(r"\n(?![-*] )", " ", "\n".join(lines)).splitlines()
            items = (f"<li>{_inline(line[2:], folder)}</li>" for line in joined)
            yield f"<ul>{''.join(items)}</ul>"
        else:
            breaks = "<br>".join(_inline(line.rstrip(), folder) for line in lines)
            spaced = "  \n" in block
            text = breaks if spaced else _inline(" ".join(lines), folder)
            yield f"<p>{text}</p>"


def _table(lines: list[str], folder: Path) -> str:
    rows = [[c.strip() for c in line.strip("| ").split(" | ")] for line in lines]
    head, *body = [rows[0], *rows[2:]]
    cells = "".join(f"<th>{_inline(c, folder)}</th>" for c in head)
    found = [f"<tr>{cells}</tr>"]
    for row in body:
        cells = "".join(_cell(c, folder) for c in row)
        found.append(f"<tr>{cells}</tr>")
    return f"<table>{''.join(found)}</table>"


def _cell(text: str, folder: Path) -> str:
    """Numbers, ranges and names stay on one line."""
    kind = " class=short" if len(text) <= _SHORT else ""
    return f"<td{kind}>{_inline(text, folder)}</td>"


def _inline(text: str, folder: Path) -> str:
    """Pictures, links, code, bold and slanted words of one line."""
    text = html.escape(text, quote=False)
    text = re.sub(
        r"!\[([^\]]*)\]\(([^)]+)\)",
        lambda m: f'<img alt="{html.escape(m[1])}" src="{_embedded(folder / m[2])}">',
        text,
    )
    text = re.sub(r"\[([^\]]+)\]\(([^)]+)\)", r'<a href="\2">\1</a>', text)
    text = re.sub(r"`([^`]+)`", r"<code>\1</code>", text)
    text = re.sub(r"\*\*([^*]+)\*\*", r"<b>\1</b>", text)
    return re.sub(r"(?<![\w*])\*([^*]+)\*(?![\w*])", r"<i>\1</i>", text)


def _embedded(path: Path) -> str:
    """The picture as a data URL; its name where it is not there."""
    if not path.is_file():
        return path.name
    data = base64.b64encode(path.read_bytes()).decode()
    return f"data:image/png;base64,{data}"
