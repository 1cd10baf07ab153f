"""The exact fallback on boards: host's bits, DAQP's answers, every status code."""

from dataclasses import replace

import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.embedding.package import with_manifest
from rrnn_opt.embedding.target.board import BOARDS
from tests.embedding.target.lab import (
    COUNT,
    FELL_BACK,
    INIT,
    ITERATIONS,
    MONITOR,
    STATUS,
    STEP,
    VERDICT,
    Bench,
)
from tests.embedding.target.scenarios import arm, scenarios, scheme

WITHIN = {"double": 1e-9, "float": 5e-4}
"""Largest distance from DAQP, rad/s: a float holds the data to 1e-7 of their
size, and the programme magnifies that."""


@pytest.mark.slow
@pytest.mark.parametrize("real", ["float", "double"])
def test_the_fallback_is_daqp_s_answer_on_every_machine(real, tmp_path):
    law = rr.networks.LviPdnn(whiten=True)(scheme())
    bench = Bench.of(law, real=real)
    told = [s.given for s in scenarios()]
    requests = bench.requests(told, h=0.004, tolerance=0.0)
    answers, _ = bench.on_host(requests, tmp_path)
    words = answers["word"]
    assert not words[:, STEP].any()
    assert (words[:, VERDICT] & FELL_BACK).all()
    assert words[:, ITERATIONS].max() >= 3
    best = np.array([s.best for s in scenarios()])
    assert np.abs(answers["output"] - best).max() < WITHIN[real]
    for name in BOARDS:
        there, _ = bench.on_board(name, requests, tmp_path)
        there["word"][:, COUNT] = 0
        assert there.tobytes() == answers.tobytes(), name


def provoked(bench):
    """A request for every status: its name, the word that tells it, the request."""
    far, huge = 1e3, 1e9
    good = {"q": np.array([0.0, -0.5, 0, -2.2, 0, 1.8, 0.7]), "rd_dot": np.zeros(3)}
    fast, lost = good | {"rd_dot": np.full(3, 50.0)}, good | {"q": np.full(7, far)}
    plain = {"h": 0.003, "tolerance": 0.05}
    rows = [
        ("OK", STEP, good, plain, 0.0),
        ("NOT_FINITE", STEP, good | {"rd_dot": np.full(3, np.nan)}, plain, 0.0),
        ("NOT_FINITE", STEP, good | {"q": np.full(7, -np.inf)}, plain, 0.0),
        ("NOT_FINITE", INIT, good, plain | {"h": np.nan}, 0.0),
        ("BAD_STEP_SIZE", INIT, good, plain | {"h": 0.0}, 0.0),
        ("STEP_TOO_LONG", INIT, good, plain | {"h": 0.1}, 0.0),
        ("BAD_TOLERANCE", INIT, good, plain | {"tolerance": -1.0}, 0.0),
        ("EMPTY_LIMITS", STEP, lost, plain, 0.0),
        ("EMPTY_LIMITS", MONITOR, lost, plain, 0.0),
        ("OUT_OF_RANGE", STEP, good | {"rd_dot": np.full(3, huge * 10)}, plain, 0.0),
        ("DIVERGED", STEP, good, plain, np.inf),
        ("DIVERGED", MONITOR, good, plain, np.nan),
        ("INFEASIBLE", STEP, fast, plain | {"tolerance": 0.0}, 0.0),
    ]
    made = [bench.requests([g], state=s, **p) for _, _, g, p, s in rows]
    return [(name, word) for name, word, *_ in rows], np.concatenate(made)


@pytest.mark.slow
@pytest.mark.parametrize("real", ["float", "double"])
@pytest.mark.parametrize("name", BOARDS)
def test_every_status_is_met_on_boards(real, name, tmp_path):
    rule = rr.networks.LviPdnn(whiten=True)
    law = rule(rr.formulations.minimum_velocity(arm()))
    bench = Bench.of(law, network=rule, real=real)
    wanted, requests = provoked(bench)
    answers, printed = bench.on_board(name, requests, tmp_path)
    assert printed == "0"
    said = [
        (STATUS[row["word"][word]], word)
        for row, (_, word) in zip(answers, wanted, strict=True)
    ]
    assert said == wanted
    assert hurried(bench, requests[:1], name, tmp_path) == "NO_ANSWER"
    assert {name for name, _ in wanted} == set(STATUS) - {"NO_ANSWER"}


def hurried(bench, request, name, folder):
    """Status of a fallback that may not make a single partial step."""
    files = dict(bench.package.files)
    text = files.pop("src/arm_qp.h")
    whole = "(4U * (RRNN_QP_ALL + RRNN_QP_N))"
    assert whole in text
    files["src/arm_qp.h"] = text.replace(whole, "0U")
    package = with_manifest("arm", files, {})
    fast = request.copy()
    fast["tolerance"], fast["rd_dot"] = 0.0, (0.0, 2.0, 0.0)
    place = folder / "hurried"
    place.mkdir()
    answers, _ = replace(bench, package=package).on_board(name, fast, place)
    return STATUS[answers[0]["word"][STEP]]
