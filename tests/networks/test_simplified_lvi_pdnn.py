import casadi as ca
import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.errors import RrnnError
from rrnn_opt.networks import PrimalDual, SimplifiedLviPdnn
from tests.networks.toy import WEIGHT, hand_error, law, point, programme


def test_the_equation_by_hand():
    dynamics = SimplifiedLviPdnn(gamma=3.0)(programme())
    rng = np.random.default_rng(0)
    for seed in range(5):
        given, y = point(seed), rng.normal(size=8)
        error, _ = hand_error(WEIGHT, given, y)
        np.testing.assert_allclose(law(dynamics, y, given), -3.0 * error, atol=1e-12)


def test_it_is_the_network_6_term_by_term():
    form = programme()
    ours, theirs = SimplifiedLviPdnn(gamma=4.0)(form), PrimalDual(epsilon=0.25)(form)
    symbols = [ours.state.sx, *(p.sx for p in form.parameters)]
    prints = {
        rr.symbolic.fingerprint(ca.Function("f", symbols, [d.derivative]))
        for d in (ours, theirs)
    }
    assert len(prints) == 1


def test_hyper_parameters_are_positive():
    with pytest.raises(RrnnError, match="gamma"):
        SimplifiedLviPdnn(gamma=-1.0)
