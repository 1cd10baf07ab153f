import json
from dataclasses import replace

import pytest

from rrnn_opt.errors import RrnnError
from rrnn_opt.formulations import clearance_rows, position_feedback
from rrnn_opt.networks import PrimalDual
from rrnn_opt.validation.tables import checks, table_1
from rrnn_opt.validation.tables.blocked import blocked, least
from rrnn_opt.validation.tables.models import MODELS, FromAnywhere
from rrnn_opt.validation.tables.table_1 import PAPER, Mark, cells, page

OF = {model.row: model for model in MODELS}
TUNED = OF["Model in [35]"]
OPEN = OF["Model in [25]"]
PROPOSED = OF["Proposed"]


def test_the_papers_words_are_eight_a_row():
    assert set(PAPER) == set(OF)
    assert {len(words.split()) for words in PAPER.values()} == {8}


@pytest.mark.parametrize("row", list(OF))
def test_inversion_is_read_from_the_graph(row):
    found, reason = checks.no_inversion(OF[row])
    assert found == PAPER[row].split()[3]
    assert ("sqrt" in reason) == (found == "No")


def test_a_whitened_network_is_not_free_of_inversion():
    whitened = replace(TUNED, network=PrimalDual(whiten=True))
    assert checks.no_inversion(whitened)[0] == "No"
    inside = replace(PROPOSED, scheme=feed_forward)
    assert checks.no_inversion(inside)[0] == "No"


def feed_forward(kin, *, contacts=()):
    return position_feedback(kin, feed_forward=True)


def test_feedback_lags_and_feed_forward_does_not():
    assert checks.theoretical_error(PROPOSED)[0] == "Nonzero"
    assert checks.theoretical_error(TUNED)[0] == "Zero"
    assert checks.theoretical_error(OF["Model in [43]"])[0] == "Nonzero"


def test_what_is_not_measured_accumulates():
    assert checks.no_accumulation(OPEN)[0] == "No"
    assert checks.no_accumulation(PROPOSED)[0] == "Yes"


def test_limits_are_kept_by_those_that_have_them():
    assert checks.physical_limits(PROPOSED, runs=3)[0] == "Yes"
    assert checks.physical_limits(OF["Model in [44]"], runs=3)[0] == "No"


def test_networks_begin_where_they_are_put():
    import rrnn_opt as rr

    kin = rr.Kinematics(rr.Robot.builtin("pa10"))
    form = position_feedback(kin)
    one, two = (FromAnywhere(PrimalDual(), seed)(form).start for seed in (0, 1))
    assert one.is_constant()
    assert str(one) != str(two)


@pytest.mark.slow
def test_an_obstacle_is_hit_without_contacts_and_cleared_with_rows():
    model = replace(PROPOSED, scheme=clearance_rows, law="reduced")
    (case,) = blocked(model, 1)
    assert least(model, case)[0] >= 0.0
    blind = replace(case, contacts=())
    seen = replace(model, scheme=_blind)
    assert least(seen, replace(blind, contacts=case.contacts))[0] < 0.0


def _blind(kin, *, contacts=()):
    return clearance_rows(kin)


def test_the_page_and_the_cells():
    found = [
        Mark("Proposed", "theoretical error", "Zero", "Nonzero", "a lag"),
        Mark("Proposed", "obstacle avoidance", "Yes", "Yes", "kept"),
        Mark("Proposed", "planning completeness", "Yes", "unknown", "not run"),
    ]
    text = page(found, "x")
    assert "**Nonzero** (paper: Zero)" in text
    assert "a lag" in text.split("Where we differ")[1].split("Where we agree")[0]
    verdicts = [cell["verdict"] for cell in cells(found)]
    unsure = "cannot be reproduced as printed"
    assert verdicts == ["not reproduced", "reproduced", unsure]
    json.dumps(cells(found))


@pytest.mark.slow
def test_a_whole_row():
    found = list(table_1.marks(2, rows=[OF["Model in [43]"]]))
    assert [m.column for m in found] == list(table_1.columns(2))
    ours = {m.column: m.ours for m in found}
    assert ours["free of error accumulation"] == "No"
    assert ours["obstacle avoidance"] == ours["planning completeness"] == "No"
    assert all(m.reason for m in found)


@pytest.mark.slow
def test_completeness_is_asked_of_the_rows_planner(monkeypatch):
    monkeypatch.setattr(table_1, "_ROLLOUTS", 5)
    found, reason = table_1.completeness(OPEN, runs=1)
    assert found == ("Yes" if "1 of 1" in reason else "No")
    assert "method1" in reason


def test_a_check_that_cannot_run_is_unknown():
    broken = replace(TUNED, scheme=position_feedback, network=no_network)
    found = list(table_1.marks(2, rows=[broken]))
    assert found[0].ours == "unknown"
    assert "refused" in found[0].reason


def no_network(form):
    raise RrnnError("refused")
