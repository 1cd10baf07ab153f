import pytest

from rrnn_opt.validation.figures import figure_3
from rrnn_opt.validation.figures.figure_3 import COLUMNS, runs
from rrnn_opt.validation.tables.tracking import SIGMAS


@pytest.mark.slow
def test_twelve_panels_of_twelve_runs(tmp_path, capsys):
    found = runs(seed=1)
    assert list(found) == [(key, sigma) for sigma in SIGMAS for key in COLUMNS]
    errors = {pair: run.rms_error_m for pair, run in found.items()}
    for key in ("method1", "method2", "method3"):
        assert errors[key, 0.25] == pytest.approx(5 * errors[key, 0.05], rel=0.15)
    assert errors["proposed", 0.25] < 1.5 * errors["proposed", 0.01]
    assert figure_3.main(["--out", str(tmp_path)]) == 0
    data = (tmp_path / "figure_3.png").read_bytes()
    assert data.startswith(b"\x89PNG")
    assert capsys.readouterr().out.strip().endswith("figure_3.png")
