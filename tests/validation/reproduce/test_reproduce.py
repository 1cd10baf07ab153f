"""The report says what the rows say: without rows nothing, with others otherwise."""

import hashlib
import json

import numpy as np
import pytest

from rrnn_opt.study import Results, Row, environment, parts, store
from rrnn_opt.validation.reproduce.cell import NO_ROWS
from rrnn_opt.validation.reproduce.cells import CEILING
from rrnn_opt.validation.reproduce.report import page, write_report
from rrnn_opt.validation.reproduce.run import (
    PARTS,
    part_of,
    run_part,
    studies,
    write_cells,
    write_rows,
)
from rrnn_opt.validation.tables import table_2
from rrnn_opt.validation.tables.printed import printed, printed_values, rows_of
from rrnn_opt.validation.tables.tracking import ENTRIES
from rrnn_opt.validation.tables.trials import SCENARIOS, TRIALS

VERDICTS = {
    "reproduced",
    "better",
    "not reproduced",
    "cannot be reproduced as printed",
}


def planning_rows(solved=True, total=4, trials=6):
    return [
        Row(
            f"{scene}/{planner}/{i}",
            {
                **{"scenario": scene, "planner": planner, "trial": i},
                **{"solved": solved, "random": total - total // 2},
                **{"heuristic": total // 2, "total": total, "plan_ms": 1.0},
            },
        )
        for scene in SCENARIOS
        for planner in TRIALS
        for i in range(trials)
    ]


def error_rows(size=0.01):
    draws = size * (1.0 + 0.1 * np.random.default_rng(0).random((3, 3, 5)))
    return [
        Row(f"{case.parameters['key']}/5", {"key": key, "errors_m": draws.tolist()})
        for case in studies(5)["table2"]
        for key in [case.parameters["key"]]
    ]


def raven_rows(solved, n=20):
    return [Row(str(k), {"start": k, "solved": k < solved}) for k in range(n)]


def test_the_papers_values_are_complete():
    values = printed_values()
    assert len([k for k in values if k[0] == "I"]) == 7 * 8
    assert len([k for k in values if k[0] == "II"]) == 4 * 3
    assert len([k for k in values if k[0] == "III"]) == 2 * 3
    assert len([k for k in values if k[0] == "IV"]) == 2 * 6
    assert rows_of("II")[0] == "Proposed"
    for scene in ("Scenario 1", "Scenario 2"):
        for side in ("Without Learning", "Proposed"):
            random, heuristic, total = (
                printed("IV", scene, f"{side} {name}") for name in ("RE", "HS", "Total")
            )
            assert random + heuristic == pytest.approx(total)


@pytest.mark.parametrize("name", PARTS)
def test_without_rows_no_cell_has_a_number_of_ours(name):
    cells = part_of(name, [], trials=50).cells
    assert cells
    for cell in cells:
        assert cell["ours"] is None
        assert cell["n"] == 0
        assert cell["interval"] == []
        assert (cell["verdict"], cell["reason"]) == ("not reproduced", NO_ROWS)


@pytest.mark.parametrize(
    ("name", "good", "other"),
    [
        ("table2", error_rows(), error_rows(0.02)),
        ("table3", planning_rows(), planning_rows(solved=False)),
        ("table4", planning_rows(), planning_rows(total=9)),
        ("raven", raven_rows(20), raven_rows(19)),
    ],
)
def test_other_rows_give_other_cells(name, good, other):
    first, second = (part_of(name, rows, trials=6) for rows in (good, other))
    assert first.digest != second.digest
    for one, two in zip(first.cells, second.cells, strict=True):
        assert one["ours"] != two["ours"]
        assert one["paper"] == two["paper"]
        assert one["ours"] is not None


def test_one_changed_row_changes_the_report():
    rows = planning_rows()
    spoilt = [*rows[:-1], Row(rows[-1].key, {**rows[-1].metrics, "solved": False})]
    said = [
        page(
            [part_of("table3", given, trials=6)],
            drawn={},
            environment=environment(),
            damaged=0,
        ).split("## ")[1]
        for given in (rows, spoilt)
    ]
    assert said[0] != said[1]


def test_intervals_and_verdicts_follow_from_the_rows():
    cells = {
        (c["row"], c["column"]): c
        for c in part_of("table3", planning_rows(), trials=6).cells
    }
    whole = cells["scenario 1 (plane)", "random-rnn"]
    assert whole["interval"] == pytest.approx([0.6097, 1.0], abs=1e-4)
    assert whole["verdict"] == "reproduced"
    assert whole["difference"] == 0.0
    assert whole["command"] == "rrnn reproduce table3 --trials 6"
    assert {c["verdict"] for c in cells.values()} <= VERDICTS


def test_the_share_of_random_steps_cannot_be_reproduced():
    part = part_of("table4", planning_rows(), trials=6)
    shares = [c for c in part.cells if c["column"].endswith("share of RE")]
    assert [c["paper"] for c in shares] == [0.872, 0.872, 0.907, 0.907]
    for cell in shares:
        assert cell["verdict"] == "cannot be reproduced as printed"
        assert cell["ours"] == pytest.approx(0.5)
        assert f"{CEILING:.4f}" in cell["reason"]


def test_the_ceiling_is_where_the_memory_cell_rests():
    """Driven by failures alone, in small Euler steps of (14)."""
    activity = 0.0
    for _ in range(20_000):
        activity += 1e-3 * (
            -0.9 * activity + (1.0 - activity) * (1.0 + 0.95 * activity)
        )
    assert pytest.approx(activity, abs=1e-6) == CEILING


def test_a_part_is_run_kept_and_taken_up(tmp_path):
    with Results(tmp_path / "rows") as results:
        part = run_part("fig4", results, trials=4)
        assert {c["verdict"] for c in part.cells} <= VERDICTS
        assert all(c["rows"] == part.digest for c in part.cells)
    with Results(tmp_path / "rows") as results:
        told = []
        again = run_part("fig4", results, trials=4, progress=lambda *n: told.append(n))
        assert told == []
        assert again.cells == part.cells


def test_a_damaged_row_is_said_and_measured_again(tmp_path, monkeypatch):
    monkeypatch.setattr(parts, "available", lambda: False)
    with Results(tmp_path) as results:
        good = run_part("fig4", results, trials=4)
    journal = tmp_path / "journal.jsonl"
    journal.write_text(
        journal.read_text().replace('"reached": true', '"reached": false')
    )
    with store.Store(tmp_path) as kept:
        left = len(list(kept))
        assert kept.damaged >= 2
    with Results(tmp_path) as results:
        assert results.damaged == 6 - left
        again = run_part("fig4", results, trials=4)
        said = page(
            [again], drawn={}, environment=environment(), damaged=results.damaged
        )
    assert again.cells == good.cells
    assert f"**{6 - left} damaged rows or files**" in said


def test_files_of_the_report(tmp_path):
    part = part_of("raven", raven_rows(20), trials=20)
    paths = write_report(
        tmp_path, [part], drawn={}, environment=environment(), damaged=0
    )
    assert [path.name for path in paths] == ["reproduce.md", "reproduce.html"]
    rows = write_rows([part], tmp_path)
    assert len(rows["raven"].read_text().splitlines()) == 20
    digest = hashlib.sha256(rows["raven"].read_bytes()).hexdigest()
    assert digest.startswith(part.digest)
    assert part.digest in (tmp_path / "reproduce.md").read_text()
    files = write_cells([part], tmp_path)
    assert json.loads(files[0].read_text())["cells"][0]["ours"] == 1.0


class Lost:
    """Workers that lose every case."""

    def rows(self, study, cases, seed):
        yield from (Row(case.key, {}, "WorkerError: died", lost=True) for case in cases)


def test_a_part_whose_workers_died_says_so(tmp_path):
    with Results(tmp_path) as results:
        part = run_part("fig4", results, trials=4, workers=Lost())
    assert {cell["ours"] for cell in part.cells} == {None}
    assert "WorkerError: died" in page(
        [part], drawn={}, environment=environment(), damaged=0
    )


def test_words_are_compared_with_words():
    rows = [
        Row(case.key, {**case.parameters, "ours": "Yes", "saw": "a check"})
        for case in studies(50)["table1"]
    ]
    cells = part_of("table1", rows, trials=50).cells
    assert len(cells) == 56
    for cell in cells:
        wanted = "reproduced" if cell["paper"] == "Yes" else "not reproduced"
        assert (cell["ours"], cell["verdict"], cell["n"]) == ("Yes", wanted, 20)


def test_a_rival_that_errs_less_than_in_the_paper_is_not_better():
    cells = part_of("table2", error_rows(1e-6), trials=5).cells
    rivals = ("Method 1", "Method 2", "Method 3")
    for cell in cells:
        rival = cell["row"].startswith(rivals)
        assert cell["verdict"] == ("not reproduced" if rival else "better")


@pytest.mark.parametrize(
    ("paper", "ours", "word"),
    [
        (0.007, 0.0074, "reproduced"),
        (0.007, 0.0076, "not reproduced"),
        (0.010, 0.0094, "better"),
    ],
)
def test_table_ii_is_compared_in_the_digits_that_it_prints(paper, ours, word):
    assert table_2.verdict(ENTRIES["proposed"], paper, ours, (ours, ours)) == word
