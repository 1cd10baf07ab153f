import json
import math

import pytest

from rrnn_opt.solving import Comparison, Residual, Status
from rrnn_opt.study import wilson
from rrnn_opt.study.comparison import summarise


def row(solver, index, *, status=Status.SOLVED, mode="warm", dual=2e-9, time_s=1e-5):
    return Comparison(
        index=index,
        solver=solver,
        mode=mode,
        status=status,
        primal=index * 1e-9,
        equality=math.nan if index == 3 else index * 2e-9,
        box=1e-12,
        residual=Residual(1e-10 * index, dual, 3e-9, 0.0),
        time_s=time_s,
        agrees=True,
    )


def test_one_row_a_solver_and_mode():
    rows = [row(s, k, time_s=1e-5 * (k + 1)) for k in range(4) for s in ("a", "b")]
    rows += [row("a", 0, mode="cold", status=Status.MAX_ITER)]
    table = summarise("circle", rows)
    keys = [(r["solver"], r["mode"]) for r in table]
    assert keys == [("a", "warm"), ("b", "warm"), ("a", "cold")]
    first, _, last = table
    assert (first["stream"], first["n"], first["solved"]) == ("circle", 4, 4)
    assert first["wilson"] == list(wilson(4, 4))
    assert first["time_us"]["p50"] == pytest.approx(25.0)
    assert first["time_us"]["max"] == pytest.approx(40.0)
    assert first["primal"] == pytest.approx(3e-10)
    assert (first["dual"], first["gap"]) == (2e-9, 3e-9)
    assert first["primal_difference"] == pytest.approx(3e-9)
    assert first["dual_difference"] == 4e-9
    assert (last["solved"], last["primal"], last["gap"]) == (0, None, None)
    json.dumps(table, allow_nan=False)
