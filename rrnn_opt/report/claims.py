"""Verdicts about claims as a table, a Markdown page and an offline HTML page.

All of them draw the document of ``rrnn verify --json``; nothing is judged here.
"""

from __future__ import annotations

import html
from collections.abc import Mapping, Sequence
from typing import Any

from rrnn_opt.report.tables import table

HEADER = ("id", "source", "verdict", "assumptions or witness", "engine", "trust", "s")
_WIDTH = 60
_STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; margin: 2rem auto; max-width: 74rem;
       padding: 0 1rem; color: #1b2733; background: #fff; }
table { border-collapse: collapse; width: 100%; }
th, td { text-align: left; vertical-align: top; padding: .5rem .6rem;
         border-bottom: 1px solid #d5dbe1; }
th { position: sticky; top: 0; background: #fff; }
td:first-child { white-space: nowrap; font-weight: 600; }
.word { font-weight: 600; white-space: nowrap; }
.PROVED { color: #136f3a; } .HOLDS_UNDER { color: #7a5c00; }
.REFUTED { color: #a4261d; } .UNKNOWN { color: #4b5763; }
small { color: #4b5763; display: block; overflow-wrap: anywhere; }
"""

Row = Mapping[str, Any]


def claims_table(rows: Sequence[Row]) -> str:
    """The rows as a table for the terminal.

    Args:
        rows: "claims" of the document.
    """
    cells = [
        (
            row["id"],
            row["source"],
            word(row),
            _shortened(because(row)),
            row["engine"],
            row["trust"],
            float(row["time_s"]),
        )
        for row in rows
    ]
    return table(HEADER, cells)


def word(row: Row) -> str:
    """The verdict, or why there is none."""
    return str(row["verdict"] if row["kind"] == "PROPOSITION" else row["kind"])


def because(row: Row) -> str:
    """What a verdict rests on: assumptions, a witness, or a reason."""
    if row["assumptions"]:
        return "; ".join(row["assumptions"])
    if row["witness"]:
        return _point(row["witness"])
    return "" if row["verdict"] == "PROVED" else str(row["reason"])


def claims_markdown(
    document: Mapping[str, Any], *, title: str, command: str, words: str = ""
) -> str:
    """A page with each statement beside what is true.

    Args:
        document: of ``rrnn verify --json``.
        title: heading.
        command: what makes the page again.
        words: a paragraph below the heading.
    """
    rows = document["claims"]
    head = ("id", "source", "as stated", "verdict", "rests on", "what is true")
    told = [words, ""] if words else []
    lines = [f"# {title}", "", *told, f"{_counted(rows)} Made by `{command}`.", ""]
    lines += [_cells(head), _cells(["---"] * len(head))]
    lines += [_cells(_described(row)) for row in rows]
    variants = [f"- {r['id']}: {_plain(r['mutation'])}" for r in rows if r["mutation"]]
    if variants:
        lines += ["", "## Mutations", ""]
        lines += ["A variant of known truth for each statement.", "", *variants]
    if document["evidence"]:
        lines += ["", "## Evidence", "", "Samples and tests; none is a verdict.", ""]
        lines += [f"- {_seen(item)}" for item in document["evidence"]]
    return "\n".join(lines) + "\n"


def claims_html(
    document: Mapping[str, Any], *, title: str, command: str, words: str = ""
) -> str:
    """The same as one offline page.

    Args:
        document: of ``rrnn verify --json``.
        title: heading.
        command: what makes the page again.
        words: a paragraph below the heading.
    """
    head = "".join(
        f"<th>{name}</th>" for name in ("", "as stated", "verdict", "what is true")
    )
    rows = "\n".join(_html_row(row) for row in document["claims"])
    seen = "".join(f"<li>{html.escape(_seen(x))}</li>" for x in document["evidence"])
    evidence = f"<h2>Evidence</h2><ul>{seen}</ul>" if seen else ""
    name = html.escape(title)
    return (
        f'<!doctype html><html lang="en"><head><meta charset="utf-8">'
        f"<title>{name}</title><style>{_STYLE}</style></head><body><h1>{name}</h1>"
        f"<p>{html.escape(words)}</p>"
        f"<p>{html.escape(_counted(document['claims']))} Made by "
        f"<code>{html.escape(command)}</code>.</p>"
        f"<table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>"
        f"{evidence}</body></html>\n"
    )


def _counted(rows: Sequence[Row]) -> str:
    names = ("PROVED", "HOLDS_UNDER", "REFUTED", "UNKNOWN")
    found = [word(row) for row in rows]
    counts = [f"{found.count(name)} {name}" for name in names]
    rest = sum(name not in names for name in found)
    return ", ".join(counts) + (f", {rest} without a verdict." if rest else ".")


def _described(row: Row) -> list[str]:
    rests = _shortened(because(row), 240)
    if row["trust"]:
        rests = f"{rests} ({row['engine']}, {row['trust']})".strip()
    texts = (row["id"], row["source"], row["statement"], word(row), rests, _truth(row))
    return [_plain(text) for text in texts]


def _truth(row: Row) -> str:
    """What is true in place of the statement."""
    repaired = row.get("repaired")
    if not repaired:
        return "as stated" if row["verdict"] == "PROVED" else ""
    under = "; ".join(repaired["assumptions"])
    text = f"{repaired['statement']}: {repaired['verdict']} ({repaired['trust']})"
    return f"{text}, under {under}" if under else text


def _html_row(row: Row) -> str:
    name = html.escape(row["id"])
    stated, rests, truth = map(
        html.escape, (row["statement"], because(row), _truth(row))
    )
    verdict = html.escape(word(row))
    how = html.escape(
        f"{row['engine'] or '-'}, {row['trust'] or '-'}, {row['time_s']:.1f} s"
    )
    variant = html.escape(f"variant: {row['mutation']}" if row["mutation"] else "")
    return (
        f"<tr><td>{name}<small>{html.escape(row['source'])}</small></td>"
        f"<td>{stated}<small>{variant}</small></td>"
        f'<td><span class="word {html.escape(row["verdict"])}">{verdict}</span>'
        f"<small>{rests}</small><small>{how}</small></td><td>{truth}</td></tr>"
    )


def _seen(item: Row) -> str:
    low, high = item["interval"]
    return (
        f"{item['claim']}: {item['kind']}, n = {item['n']}, "
        f"[{low:.4g}, {high:.4g}], seed {item['seed']}"
    )


def _point(witness: Mapping[str, Sequence[str]]) -> str:
    parts = [
        f"{name} = {values[0] if len(values) == 1 else '(' + ', '.join(values) + ')'}"
        for name, values in witness.items()
    ]
    return "witness " + ", ".join(parts)


def _shortened(text: str, width: int = _WIDTH) -> str:
    return text if len(text) <= width else text[: width - 3] + "..."


def _cells(cells: Sequence[str]) -> str:
    return "| " + " | ".join(cells) + " |"


def _plain(text: str) -> str:
    """Text that keeps its place in a table."""
    return " ".join(str(text).split()).replace("|", "\\|").replace("*", "\\*")
