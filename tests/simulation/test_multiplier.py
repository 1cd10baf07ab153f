"""The integrator inside the network, beside differences of the tip's position."""

import casadi as ca
import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.errors import RrnnError
from rrnn_opt.networks import Hildreth, PrimalDual
from rrnn_opt.simulation.multiplier import integrated

EPSILON, OUTER = 0.02, 0.05
"""Time constants of the network and of the integrator, s: unlike on purpose."""


@pytest.fixture(scope="module")
def kin(pa10):
    return rr.Kinematics(pa10)


@pytest.fixture(scope="module")
def plain(kin):
    return PrimalDual(epsilon=EPSILON)(rr.formulations.classical(kin))


@pytest.fixture(scope="module")
def whole(plain, kin):
    return integrated(plain, kin, None, OUTER)


def parts(dynamics, *names):
    arguments = [dynamics.state.sx, *(p.sx for p in dynamics.parameters)]
    return ca.Function("f", arguments, [getattr(dynamics, name) for name in names])


def test_the_state_goes_on_with_the_multiplier_and_the_command_becomes_its_input(
    plain, whole
):
    assert [p.name for p in plain.parameters] == ["q", "lam"]
    assert [p.name for p in whole.parameters] == ["q", "rd_dot"]
    assert whole.state.sx.numel() == plain.state.sx.numel() + 3
    start = ca.Function("s", [p.sx for p in whole.parameters], [whole.start])
    np.testing.assert_array_equal(start(np.ones(7), np.ones(3))[-3:], 0.0)


def test_its_rate_is_the_missing_task_velocity(kin, plain, whole):
    """lam' = (rd_dot - J u) / epsilon, J u by differences; u' as without it."""
    tip = ca.Function("tip", [kin.q], [kin.position()])
    inside, alone = parts(whole, "derivative", "residual"), parts(plain, "derivative")
    commanded, rng, step = parts(plain, "output"), np.random.default_rng(0), 1e-6
    for _ in range(5):
        q, wanted = rng.uniform(-1, 1, 7), rng.normal(size=3)
        x, lam = rng.normal(size=plain.state.sx.numel()), rng.normal(size=3)
        u = np.array(commanded(x, q, lam))[:7, 0]
        ahead, behind = (np.array(tip(q + s * u))[:, 0] for s in (step, -step))
        missing = wanted - (ahead - behind) / (2 * step)
        found = inside(np.append(x, lam), q, wanted)
        derivative, residual = (np.array(v)[:, 0] for v in found)
        np.testing.assert_allclose(derivative[-3:], missing / OUTER, atol=1e-6)
        np.testing.assert_allclose(residual[-3:], missing, atol=1e-7)
        before = np.array(alone(x, q, lam))[:, 0]
        np.testing.assert_allclose(derivative[:-3], before, atol=1e-12)


def test_a_network_without_a_multiplier_is_left_alone(kin):
    other = PrimalDual(epsilon=EPSILON)(rr.formulations.minimum_velocity(kin))
    assert integrated(other, kin, None, OUTER) is other


def test_a_network_that_jumps_cannot_integrate(kin):
    jumps = Hildreth()(rr.formulations.classical(kin))
    with pytest.raises(RrnnError, match="needs an ODE"):
        integrated(jumps, kin, None, OUTER)
