"""Rows that survive: interruption, truncation, corruption, a full disk."""

import json
import os

import pytest

from rrnn_opt.study import Results, Row, StoreError, parts, store, table
from rrnn_opt.study.identity import code_fingerprint, surroundings


@pytest.fixture(params=["parquet", "lines"])
def form(request, monkeypatch):
    """With pyarrow, and as if it were not installed."""
    if request.param == "lines":
        monkeypatch.setattr(parts, "available", lambda: False)
    else:
        pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    return request.param


def whole(study, folder):
    with Results(folder) as results:
        return table(results.finish(study))


def keys(folder):
    with store.Store(folder) as kept:
        return [entry["key"] for entry in kept]


def test_stopped_and_resumed_equals_uninterrupted(studies, tmp_path, form):
    study = studies.Draws(30)
    for stop in (7, 12):
        with Results(tmp_path / "stopped") as results:
            stream = results.run(study)
            for _ in range(stop):
                next(stream)
            stream.close()
    with Results(tmp_path / "stopped") as results:
        assert sum(1 for _ in results.run(study)) == 30 - 19
        resumed = table(results.rows(study))
    assert resumed == whole(study, tmp_path / "whole")
    assert len(resumed.splitlines()) == 30
    assert sorted(keys(tmp_path / "stopped")) == sorted(c.key for c in study)


def test_the_form_does_not_show_in_the_rows(studies, tmp_path, monkeypatch):
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    study = studies.Draws(5)
    parquet = whole(study, tmp_path / "parquet")
    assert list((tmp_path / "parquet").glob("*.parquet"))
    monkeypatch.setattr(parts, "available", lambda: False)
    assert whole(study, tmp_path / "lines") == parquet
    assert not list((tmp_path / "lines").glob("*.parquet"))


def test_a_folder_of_lines_is_taken_up_with_parquet(studies, tmp_path, monkeypatch):
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    with monkeypatch.context() as without:
        without.setattr(parts, "available", lambda: False)
        whole(studies.Draws(3), tmp_path)
    with Results(tmp_path) as results:
        assert sum(1 for _ in results.run(studies.Draws(5))) == 2
    assert sorted(keys(tmp_path)) == [f"case/{k}" for k in range(5)]


def test_parquet_is_named_where_it_is_needed(studies, tmp_path, monkeypatch):
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    whole(studies.Draws(2), tmp_path)
    monkeypatch.setattr(parts, "available", lambda: False)
    with pytest.raises(StoreError, match=r"rrnn_opt\[study\]"):
        Results(tmp_path)


@pytest.mark.parametrize("left", [0, 100, 1000])
def test_a_truncated_last_part_is_redone(studies, tmp_path, left):
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    study = studies.Draws(6)
    good = whole(study, tmp_path)
    (part,) = tmp_path.glob("part-*.parquet")
    os.truncate(part, left)
    with Results(tmp_path) as results:
        assert results.damaged == 1
        assert sum(1 for _ in results.run(study)) == 6
        assert table(results.rows(study)) == good


def test_a_line_cut_off_is_redone(studies, tmp_path, monkeypatch):
    monkeypatch.setattr(parts, "available", lambda: False)
    study = studies.Draws(4)
    good = whole(study, tmp_path)
    journal = tmp_path / "journal.jsonl"
    os.truncate(journal, journal.stat().st_size - 9)
    with Results(tmp_path) as results:
        assert [row.key for row in results.run(study)] == ["case/3"]
        assert table(results.rows(study)) == good


def test_a_changed_number_is_noticed_and_measured_again(studies, tmp_path, form):
    study = studies.Draws(4)
    good = whole(study, tmp_path)
    if form == "lines":
        journal = tmp_path / "journal.jsonl"
        lines = [json.loads(line) for line in journal.read_text().splitlines()]
        lines[2]["metrics"]["first"] = 0.5
        journal.write_text("".join(json.dumps(line) + "\n" for line in lines))
    else:
        (path,) = tmp_path.glob("*.parquet")
        entries = list(parts.read_part(path))
        entries[2]["metrics"]["first"] = 0.5
        parts.write_part(path, entries)
    with Results(tmp_path) as results:
        assert results.damaged == 1
        assert [row.key for row in results.run(study)] == ["case/2"]
        assert table(results.rows(study)) == good


def test_rows_count_for_their_seed_code_and_versions_only(
    studies, tmp_path, monkeypatch
):
    study = studies.Draws(3)
    whole(study, tmp_path)
    with Results(tmp_path, seed=1) as results:
        assert results.rows(study) == []
    with Results(tmp_path, packages=("pytest",)) as results:
        assert results.rows(study) == []
    monkeypatch.setattr("rrnn_opt.study.identity.code_fingerprint", lambda: "other")
    with Results(tmp_path) as results:
        assert results.rows(study) == []
    monkeypatch.undo()
    assert len(code_fingerprint()) == len(surroundings()) == 16


def test_without_resume_the_earlier_rows_are_set_aside(studies, tmp_path):
    folder = tmp_path / "rows"
    whole(studies.Draws(3), folder)
    with Results(folder, resume=False) as results:
        assert results.rows(studies.Draws(3)) == []
    assert len(keys(tmp_path / "rows.before")) == 3


def test_two_runs_do_not_write_into_one_folder(tmp_path):
    with (
        Results(tmp_path),
        pytest.raises(StoreError, match="another run writes there"),
    ):
        Results(tmp_path)
    Results(tmp_path).close()


def test_a_case_that_lost_its_worker_is_tried_again_by_the_next_run(studies, tmp_path):
    with Results(tmp_path) as results:
        found = list(results.run(studies.Draws(3, deadly=1), jobs=2))
        assert [row.key for row in found if row.lost] == ["case/1"]
    with Results(tmp_path) as results:
        again = list(results.run(studies.Draws(3)))
        assert [row.key for row in again] == ["case/1"]


def test_progress_counts_what_was_there(studies, tmp_path):
    with Results(tmp_path) as results:
        stream = results.run(studies.Draws(5))
        next(stream)
        stream.close()
    told = []
    with Results(tmp_path) as results:
        results.finish(studies.Draws(5), progress=lambda *n: told.append(n))
    assert told == [(k, 5) for k in range(2, 6)]


def test_the_table_is_sorted_and_knows_no_times():
    rows = [
        Row("b", {"x": 1, "plan_s": 2.0, "deep": {"t_us": 1, "y": 2}}),
        Row("a", {}, "E: no"),
    ]
    assert table(rows) == b'["a", {}, "E: no"]\n["b", {"deep": {"y": 2}, "x": 1}, ""]\n'


def test_duckdb_reads_the_rows(studies, tmp_path):
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    duckdb = pytest.importorskip("duckdb", reason="duckdb is not installed")
    with Results(tmp_path) as results:
        rows = results.finish(studies.Draws(6))
    ((count, mean, top),) = duckdb.sql(
        "select count(*), avg(first), max(curve[2]) from "
        f"read_parquet('{tmp_path}/*.parquet', union_by_name = true)"
    ).fetchall()
    assert count == 6
    assert mean == pytest.approx(sum(r.metrics["first"] for r in rows) / 6)
    assert top == max(r.metrics["curve"][1] for r in rows)
