import pytest

from rrnn_opt.study import Here, Processes, WorkerError, rows, run


def by_key(found):
    return {row.key: (row.metrics["first"], row.metrics["curve"]) for row in found}


def test_workers_that_die_are_replaced_and_their_case_is_repeated(studies, tmp_path):
    whole = by_key(run(studies.Draws(8), seed=2))
    mortal = studies.Draws(8, deadly=3, flag=str(tmp_path / "died"))
    found = list(rows(mortal, workers=Processes(2), seed=2))
    assert (tmp_path / "died").exists()
    assert sorted(row.key for row in found) == sorted(whole)
    assert by_key(found) == whole


def test_a_case_that_kills_every_worker_is_a_row_and_the_study_goes_on(studies):
    found = {row.key: row for row in rows(studies.Draws(5, deadly=1), jobs=2)}
    assert len(found) == 5
    assert found["case/1"].lost
    assert "every worker that took this case died" in found["case/1"].error
    assert not any(found[f"case/{k}"].lost for k in (0, 2, 3, 4))


def test_workers_compute_with_one_thread(studies, monkeypatch):
    monkeypatch.setenv("OMP_NUM_THREADS", "7")
    told = [row.metrics["omp"] for row in rows(studies.Threads(), jobs=2)]
    assert told == ["1", "1"]


def test_a_bug_in_a_worker_is_raised_here_with_its_traceback(studies):
    with pytest.raises(ZeroDivisionError, match="by design") as caught:
        list(rows(studies.Broken(4), jobs=2))
    assert "in measure" in str(caught.value.__cause__)


def test_a_worker_that_cannot_start_is_said(studies):
    with pytest.raises(WorkerError, match="before its first case"):
        list(rows(studies.Unborn(2), jobs=2))


def test_rows_can_be_left_early(studies):
    """The workers end; nothing is waited for."""
    stream = rows(studies.Draws(50, wait_s=0.2), jobs=2)
    assert next(stream).metrics
    stream.close()


def test_here_goes_in_order(studies):
    study = studies.Draws(4)
    found = [row.key for row in Here().rows(study, iter(study), 0)]
    assert found == [f"case/{k}" for k in range(4)]


@pytest.mark.slow
def test_a_case_that_takes_too_long_is_ended(studies):
    workers = Processes(2, patience_s=6.0)
    found = list(rows(studies.Draws(3, stuck=1), workers=workers))
    errors = {row.key: row.error for row in found}
    assert errors["case/1"] == "WorkerError: no answer within 6 s"
    assert errors["case/0"] == errors["case/2"] == ""
