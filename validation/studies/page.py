"""The ground truth as a page of Markdown."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from rrnn_opt.validation.studies.tally import AnswerTally, PointTally, add

Rows = Sequence[Mapping[str, Any]]

_FAILURES = 60


def markdown(results: Rows, table: Rows, *, title: Sequence[str]) -> str:
    """The page: what was run, then sums by network, by solver and by scheme.

    Args:
        results: metrics of the studies' rows.
        table: one row a pair and robot, from ``documents.pairs``.
        title: lines at the top.
    """
    networks = [row for row in table if row["kind"] == "network"]
    solvers = [row for row in table if row["kind"] == "solver"]
    robots = ", ".join(dict.fromkeys(str(row["robot"]) for row in table))
    parts = [
        f"# Networks against QP solvers: {robots}",
        "\n".join(f"- {line}" for line in title),
        _LEGEND,
        "## Points",
        _points_table(results),
        "## Networks, over all schemes",
        _answers_table(networks, ("who", "robot")),
        "## Solvers, over all schemes",
        _answers_table(solvers, ("who", "robot")),
        "## Schemes, over all networks and robots",
        _answers_table(networks, ("scheme",)),
        "## Who was not right",
        _failures(table),
        "## Programmes without a solution",
        _infeasible_table(results),
        "## Schemes that a network refuses",
        _refusals(results),
    ]
    return "\n\n".join(parts) + "\n"


_LEGEND = """\
Each network of each scheme is settled on each point; OSQP, DAQP, ProxQP and PIQP solve
the same programme with tight settings.  A point is *well* conditioned when its active
rows have a condition number of at most 1e3 and the cost is curved along their kernel;
*proved* when one linear solve on the active rows gave an optimum as well.  An answer is
*right* within 1e-6 of the truth (multipliers: relative to 1 + the largest, where they
are unique), and at other points when its KKT residual is within 1e-6 times 1 + the
largest multiplier.  Columns *x* and *multipliers* are the worst distance to the truth
at well points, *KKT* the worst residual of all.  *Newton* counts answers that the
network alone had not finished after a burst of steps, and that Newton steps on its own
residual did."""


def _points_table(results: Rows) -> str:
    """Shares over the schemes that have bounds or contacts, and the least of one."""
    each: dict[tuple[str, str], PointTally] = {}
    have: dict[tuple[str, str], Mapping[str, Any]] = {}
    for row in results:
        if "points" in row:
            place = (row["robot"], row["scheme"])
            add(each.setdefault(place, PointTally()), row["points"])
            have[place] = row
    lines = []
    for robot in dict.fromkeys(place[0] for place in each):
        tallies = {p: t for p, t in each.items() if p[0] == robot}
        bound = [(t.bound, t.n) for p, t in tallies.items() if have[p]["bounded"]]
        contact = [(t.contact, t.n) for p, t in tallies.items() if have[p]["contacts"]]
        every = list(tallies.values())
        n = sum(t.n for t in every)
        well, proved = sum(t.well for t in every), sum(t.proved for t in every)
        none = sum(t.none for t in every)
        parts = (*_shares(bound), *_shares(contact), _share(well, n))
        fewest = min(t.n for t in every)
        lines.append((robot, n, fewest, none, *parts, _share(proved, n)))
    head = (
        *("robot", "points", "fewest of a scheme", "not drawn"),
        *("active bound", "least of a scheme", "obstacle acts", "least of a scheme"),
        *("well", "proved"),
    )
    return _table(head, lines)


def _shares(parts: Sequence[tuple[int, int]]) -> tuple[str, str]:
    """Over all schemes, and the least of one."""
    if not parts:
        return "-", "-"
    least = min(parts, key=lambda part: part[0] / max(part[1], 1))
    return _share(sum(p[0] for p in parts), sum(p[1] for p in parts)), _share(*least)


_ANSWERS = (
    *("n", "right", "wrong", "no answer", "of them well"),
    *("Newton", "x", "multipliers", "KKT"),
)


def _answers_table(table: Rows, by: tuple[str, ...]) -> str:
    sums: dict[tuple[str, ...], AnswerTally] = {}
    for row in table:
        key = tuple(row[name] for name in by)
        add(sums.setdefault(key, AnswerTally()), row)
    lines = [
        (
            *key,
            t.n,
            _share(t.right, t.n),
            t.wrong,
            t.n - t.answered,
            t.missed,
            _share(t.newton, t.n),
            f"{t.truth_primal:.1e}",
            f"{t.truth_dual:.1e}",
            f"{t.residual:.1e}",
        )
        for key, t in sorted(sums.items())
    ]
    return _table((*by, *_ANSWERS), lines)


def _failures(table: Rows) -> str:
    """Every pair with an answer that is wrong or missing, most first."""
    missed = [row for row in table if row["n"] > row["right"]]
    missed.sort(key=lambda row: row["right"] - row["n"])
    head = (
        *("who", "scheme", "robot", "wrong", "no answer", "of them well"),
        *("why", "first points"),
    )
    lines = [
        (
            row["who"],
            row["scheme"],
            row["robot"],
            row["wrong"],
            row["n"] - row["answered"],
            row["missed"],
            ", ".join(f"{k} {v}" for k, v in row["statuses"].items()),
            " ".join(row["examples"]),
        )
        for row in missed[:_FAILURES]
    ]
    more = len(missed) - _FAILURES
    return _table(head, lines) + (f"\n\n{more} more in the CSV." if more > 0 else "")


def _infeasible_table(results: Rows) -> str:
    """What was said, what was handed out, and what we judged, counted."""
    sums: dict[str, Counter[str]] = {}
    for row in results:
        for who, said in row.get("infeasible", {}).items():
            sums.setdefault(who, Counter()).update(said)
    lines = [(who, *_sorted_words(said)) for who, said in sums.items()]
    return _table(("who", "says", "hands out", "we judge"), lines)


def _sorted_words(said: Mapping[str, int]) -> tuple[str, str, str]:
    says: list[str] = []
    hands: list[str] = []
    judged: list[str] = []
    for word, count in said.items():
        first, _, rest = word.partition(" ")
        kind = {"x": hands, "judged": judged}.get(first)
        if kind is None:
            says.append(f"{word} {count}")
        else:
            kind.append(f"{rest} {count}")
    return ", ".join(says), ", ".join(hands), ", ".join(judged)


def _refusals(results: Rows) -> str:
    refused: dict[tuple[str, str], set[str]] = {}
    for row in results:
        for who, why in row.get("refused", {}).items():
            reason = why.removeprefix(f"{who}: {row['scheme'].split('/')[0]} ")
            refused.setdefault((who, reason), set()).add(row["scheme"])
    lines = [(who, why, len(names)) for (who, why), names in sorted(refused.items())]
    return _table(("network", "why", "schemes"), lines)


def _share(part: int, whole: int) -> str:
    """A share in per cent that says 100 only of all."""
    if whole == 0:
        return "-"
    text = f"{100.0 * part / whole:.2f} %"
    return "< 100 %" if text.startswith("100") and part < whole else text


def _table(head: Sequence[str], lines: Iterable[Sequence[Any]]) -> str:
    rows = [head, ["---"] * len(head), *lines]
    return "\n".join("| " + " | ".join(str(v) for v in row) + " |" for row in rows)
