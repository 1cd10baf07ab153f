"""What a run says of itself: figures, document and table."""

import csv
from dataclasses import replace

import numpy as np
import pytest

from rrnn_opt.formulations import position_feedback
from rrnn_opt.simulation.simulate import simulate


def test_limits_are_watched(pa10, circle):
    task = circle(duration=1.0)
    result = simulate(position_feedback, pa10, task)
    assert result.limits_kept
    fast = replace(result.record, velocity=result.record.velocity + 8.0)
    assert not replace(result, record=fast).limits_kept
    far = replace(result.record, q=result.q - 9.0)
    assert not replace(result, record=far).limits_kept


def test_the_document_and_the_table(pa10, circle, tmp_path):
    result = simulate("position_feedback", pa10, circle(duration=0.5, seed=9))
    document = result.to_dict(files=[tmp_path / "run.csv"])
    contract = {
        "rms_error_m",
        "max_error_m",
        "duration_s",
        "steps",
        "limits_kept",
        "seed",
        "files",
    }
    assert contract <= set(document)
    assert (document["steps"], document["seed"]) == (50, 9)
    assert document["duration_s"] == pytest.approx(0.5)
    assert document["max_error_m"] >= document["rms_error_m"] > 0.0
    result.write_csv(tmp_path / "run.csv")
    with (tmp_path / "run.csv").open() as file:
        head, *rows = list(csv.reader(file))
    assert head[:3] == ["t", "q1", "q2"]
    assert len(rows) == 51
    values = np.array(rows, dtype=float)
    np.testing.assert_array_equal(values[:, 1:8], result.q)
    np.testing.assert_array_equal(values[:, -3:], result.reference)
