"""Host, tape and boards compute the same bits along runs of the simulator."""

import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.embedding.target.board import BOARDS
from tests.embedding.target.lab import (
    BOUND_ACTIVE,
    COUNT,
    MONITOR,
    ROW_ACTIVE,
    SEEN,
    STEP,
    Bench,
)
from tests.embedding.target.scenarios import scenarios, scheme

STEP_SIZE = 0.004
TICKS = 3
"""Calls of step in each scenario: the network follows, it does not settle."""


def told():
    return [s.given for s in scenarios() for _ in range(TICKS)]


def equal_bits(ours, theirs):
    return ours.tobytes() == theirs.tobytes()


@pytest.mark.slow
@pytest.mark.parametrize("real", ["float", "double"])
def test_two_hundred_scenarios_to_the_bit(real, tmp_path):
    assert sum(s.bounds > 0 for s in scenarios()) > 100
    assert sum(s.rows > 0 for s in scenarios()) > 50
    law = rr.networks.LviPdnn(whiten=True)(scheme())
    bench = Bench.of(law, real=real, fallback=False)
    requests = bench.requests(told(), h=STEP_SIZE)
    requests["fresh"] = np.arange(len(requests)) % (50 * TICKS) == 0
    want = bench.by_tape(requests)
    answers, printed = bench.on_host(requests, tmp_path)
    assert printed == "0"
    assert len(answers) == len(requests) >= 600
    assert not answers["word"][:, [STEP, MONITOR]].any()
    np.testing.assert_array_equal(answers["state"], want["next"])
    np.testing.assert_array_equal(answers["output"], want["output"])
    np.testing.assert_array_equal(answers["said"][:, 0], want["residual"][:, 0])
    np.testing.assert_array_equal(answers["said"][:, 1], want["merit"][:, 0])
    for bit in (BOUND_ACTIVE, ROW_ACTIVE):
        assert np.count_nonzero(answers["word"][:, SEEN] & bit) > 50
    for name, board in BOARDS.items():
        there, printed = bench.on_board(name, requests, tmp_path)
        assert printed == "0"
        counts = there["word"][:, COUNT].copy()
        there["word"][:, COUNT] = 0
        assert equal_bits(there, answers), name
        if real in board.hardware:
            assert np.ptp(counts) <= 1, name


@pytest.mark.slow
def test_flags_that_fuse_are_caught_by_the_self_test(tmp_path):
    law = rr.networks.LviPdnn(whiten=True)(scheme())
    bench = Bench.of(law, real="float", fallback=False)
    requests = bench.requests(told()[:1], h=STEP_SIZE)
    fused = ["-ffp-contract=fast"]
    _, printed = bench.on_board("cortex-m4f", requests, tmp_path, flags=fused)
    assert int(printed) > 0
