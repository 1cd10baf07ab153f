"""The plain step stays small: seven joints, two control points, one ball."""

from functools import partial

import numpy as np
import pytest

from benchmarks.embedded import codes
from benchmarks.embedded.table import cost
from rrnn_opt.embedding.target.board import BOARDS

M4F = BOARDS["cortex-m4f"]


@pytest.mark.slow
def test_the_plain_step_s_budget_and_casadi_s():
    ours = cost(partial(codes.ours, whiten=False), "float", M4F)
    theirs = cost(codes.casadi_output, "float", M4F)
    assert ours.flash <= 5300
    assert ours.counts.max() <= 1518
    assert np.ptp(ours.counts) <= 1
    assert theirs.counts.min() >= 10 * ours.counts.max()
    assert abs(ours.error - theirs.error) < 1e-4  # the same function


@pytest.mark.slow
def test_the_package_with_contacts_stays_below_2000():
    found = cost(partial(codes.package, exact=False), "float", M4F)
    assert found.counts.max() <= 2000
    assert np.ptp(found.counts) <= 1
