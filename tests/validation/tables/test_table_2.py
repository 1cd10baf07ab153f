import json
from dataclasses import replace

import numpy as np
import pytest

from rrnn_opt.validation.tables import table_2
from rrnn_opt.validation.tables.search import FIRST_SEED, search
from rrnn_opt.validation.tables.table_2 import cells, page
from rrnn_opt.validation.tables.table_2_rows import Result, best, interval
from rrnn_opt.validation.tables.tracking import CIRCLES, ENTRIES, SIGMAS, Runner, task


def fake(key, level, *, seeds=5):
    """A row whose errors are ``level`` times sigma, with some spread."""
    spread = 1.0 + 0.01 * np.random.default_rng(1).standard_normal((3, 3, seeds))
    errors = level * np.array(SIGMAS)[:, None, None] * spread
    trials = search(replace(ENTRIES["open"], ranges={}), seeds=1)
    return Result(key, trials, errors, (1.0, 1.0, 1.0), 0.0)


def test_the_interval_covers_the_mean_as_often_as_it_says():
    rng = np.random.default_rng(0)
    hits = 0
    for _ in range(400):
        low, high = interval(rng.normal(3.0, 2.0, 12))
        hits += low <= 3.0 <= high
    assert 0.92 < hits / 400 < 0.98
    assert interval(np.array([2.0])) == (2.0, 2.0)


def test_the_tasks_start_on_their_circles():
    for circle in CIRCLES:
        quiet = Runner(ENTRIES["forward"], {}).run(circle, 0.0, 0)
        np.testing.assert_allclose(quiet.error[0], 0.0, atol=1e-12)
        assert np.ptp(quiet.reference, axis=0).max() == pytest.approx(0.3, abs=1e-3)
        assert quiet.limits_kept
    noise = task("A", 0.05, 3).noise
    assert (noise.enters, noise.sigma, noise.seed) == ("joint_velocity", 0.05, 3)


def test_the_printed_law_lags_and_feed_forward_does_not():
    lag = [Runner(ENTRIES["proposed"], {}).run("A", s, 0).rms_error_m for s in SIGMAS]
    told = [Runner(ENTRIES["forward"], {}).run("A", s, 0).rms_error_m for s in SIGMAS]
    assert lag[0] == pytest.approx(5.6e-3, rel=0.05)
    assert lag[2] < 1.3 * lag[0]
    assert told[0] < 0.05 * lag[0]
    assert told[2] == pytest.approx(5.0 * told[1], rel=0.1)


@pytest.mark.slow
def test_a_quiet_posture_is_better_than_the_same_feedback_without():
    gains = {"kappa": 90.0}
    plain, quiet = (
        [Runner(ENTRIES[k], g).run(c, 0.05, 0).rms_error_m for c in CIRCLES]
        for k, g in (("closed_loop", gains), ("quiet", gains | {"gain": 10.0}))
    )
    assert all(q < 0.97 * p for q, p in zip(quiet, plain, strict=True))


@pytest.mark.slow
def test_the_search_is_seeded_sorted_and_keeps_to_its_ranges():
    entry = ENTRIES["forward"]
    one, two = (search(entry, points=2, seeds=1) for _ in range(2))
    assert [(t.gains, t.score) for t in one] == [(t.gains, t.score) for t in two]
    assert one[0].score <= one[1].score
    low, high = entry.ranges["epsilon"]
    assert all(low <= t.gains["epsilon"] <= high for t in one)
    assert FIRST_SEED > 10_000


def test_cells_have_the_form_of_reproduce_and_rows_without_paper_none():
    rows = [fake("quiet", 0.01), fake("method1", 2.0), fake("open", 2.0)]
    made = cells(rows, command="x")
    assert len(made) == 6
    keys = {"table", "row", "column", "paper", "ours", "interval", "n", "verdict"}
    assert keys | {"reason", "command"} == set(made[0])
    assert made[0]["verdict"] == "better"
    assert made[0]["interval"][0] < made[0]["ours"] < made[0]["interval"][1]
    json.dumps(made)


@pytest.mark.slow
def test_the_page_says_where_intervals_overlap():
    near = [fake("quiet", 0.0100), fake("method3", 0.0101)]
    apart = [fake("quiet", 0.0100), fake("method3", 0.0200)]
    assert best(apart, 0)[2]
    assert not best([near[0], replace(near[0], key="method3")], 0)[2]
    assert "the intervals do not overlap" in page(apart, "x")
    same = [near[0], replace(near[0], key="method3")]
    assert "**the intervals overlap.**" in page(same, "x")
    worse = [fake("quiet", 1.0), fake("method3", 2.0)]
    assert "is not reached" in page(worse, "x")


@pytest.mark.slow
def test_the_whole_table_small(tmp_path, monkeypatch, capsys):
    kept = {k: ENTRIES[k] for k in ("proposed", "quiet", "method1", "method3")}
    monkeypatch.setattr(table_2, "ENTRIES", kept)
    words = ["--seeds", "2", "--points", "4", "--out", str(tmp_path)]
    assert table_2.main(words) == 0
    text = (tmp_path / "table_2.md").read_text()
    assert "--seeds 2 --points 4" in text
    assert capsys.readouterr().out.strip() == text.strip()
    document = json.loads((tmp_path / "table_2.json").read_text())
    ours = {(c["row"], c["column"]): c["ours"] for c in document["cells"]}
    rows = {entry.label: key for key, entry in kept.items()}
    for sigma in SIGMAS:
        column = f"sigma = {sigma}"
        found = {rows[row]: x for (row, c), x in ours.items() if c == column}
        assert found["quiet"] < found["method1"]
    assert set(document["search"]) == set(kept)
