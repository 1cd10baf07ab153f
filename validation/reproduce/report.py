"""The report of ``rrnn reproduce``: one page, Markdown and HTML."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from rrnn_opt.report import write_text
from rrnn_opt.report.markdown import markdown_table
from rrnn_opt.report.simple_page import html_page
from rrnn_opt.validation.reproduce.run import Part

TITLES = {
    "table1": "Table I: what the schemes can do",
    "table2": "Table II: tracking error under noise [m]",
    "table3": "Table III: planning success",
    "table4": "Table IV: explorations",
    "fig3": "Figure 3: error along the circle",
    "fig4": "Figure 4: example motions",
    "fig5": "Figure 5: activity of the memory cell",
    "raven": "Raven II through an opening of 4 cm",
}
_HEAD = (
    *("row", "column", "paper", "ours", "95 % interval", "difference", "n"),
    *("verdict", "reason"),
)
_ABOUT = """\
*reproduced*: the paper's number lies in our 95 % interval (in Table II widened by half
of its last printed digit, 0.0005 m), or the words agree; *better* and *not reproduced*:
it does not, and a rival's row is never better. *cannot be reproduced as printed*: what
is printed contradicts itself or leaves open what decides the outcome. Numbers of
ours come from the rows of the studies alone; each part names the command and a digest
of its rows, which stand beside this page as JSON lines and in `rows/` as Parquet."""


def write_report(
    out: Path,
    parts: Sequence[Part],
    *,
    drawn: Mapping[str, Path],
    environment: Mapping[str, Any],
    damaged: int,
) -> tuple[Path, ...]:
    """Write ``reproduce.md`` and ``reproduce.html``.

    Args:
        out: folder; pictures stand in it.
        parts: in order.
        drawn: picture of each part that has one.
        environment: of the run.
        damaged: rows found broken in the folder and measured again.
    """
    text = page(parts, drawn=drawn, environment=environment, damaged=damaged)
    whole = html_page(text, title="The paper run again", folder=out)
    return (
        write_text(out / "reproduce.md", text),
        write_text(out / "reproduce.html", whole),
    )


def page(
    parts: Sequence[Part],
    *,
    drawn: Mapping[str, Path],
    environment: Mapping[str, Any],
    damaged: int,
) -> str:
    """The report in Markdown."""
    versions = ", ".join(f"{k} {v}" for k, v in environment["versions"].items())
    sections = [
        "# The paper run again",
        f"{environment['processor']}, {environment['cores']} cores, Python "
        f"{environment['python']}; {versions}; commit {environment['commit']}; "
        f"{environment['date']}.",
        _ABOUT,
        _overview(parts),
    ]
    if damaged:
        sections.append(
            f"**{damaged} damaged rows or files** of an earlier run were found and "
            "not used; their cases were measured again."
        )
    for part in parts:
        sections += [f"## {TITLES[part.name]}", _made(part)]
        if part.name in drawn:
            sections.append(f"![{part.name}]({drawn[part.name].name})")
        sections.append(_cells(part))
    return "\n\n".join(sections) + "\n"


def _overview(parts: Sequence[Part]) -> str:
    words = (
        "reproduced",
        "better",
        "not reproduced",
        "cannot be reproduced as printed",
    )
    counts = {p.name: Counter(c["verdict"] for c in p.cells) for p in parts}
    lines = [[TITLES[n], *(counts[n][w] for w in words)] for n in counts]
    return markdown_table(("part", *words), lines)


def _made(part: Part) -> str:
    command = part.cells[0]["command"]
    spent = sum(row.time_s for row in part.rows)
    failed = [f"{row.key}: {row.error}" for row in part.rows if row.error]
    text = (
        f"`{command}`; {len(part.rows)} rows, {spent:.0f} s of work, digest "
        f"`{part.digest}` of [{part.name}.jsonl]({part.name}.jsonl)."
    )
    return text + ("" if not failed else " Failed: " + "; ".join(failed) + ".")


def _cells(part: Part) -> str:
    lines = [
        (
            *(c["row"], c["column"], c["paper"], _number(c["ours"])),
            _interval(c["interval"]),
            _number(c["difference"]),
            *(c["n"], c["verdict"], c["reason"]),
        )
        for c in part.cells
    ]
    return markdown_table(_HEAD, lines)


def _number(value: Any) -> Any:
    return f"{value:.4g}" if isinstance(value, float) else value


def _interval(bounds: Sequence[float]) -> str:
    return "" if not bounds else f"{bounds[0]:.4g} to {bounds[1]:.4g}"
