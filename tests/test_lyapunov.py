import casadi as ca
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import rrnn_opt as rr
from rrnn_opt.dynamics import NeuralDynamics
from rrnn_opt.errors import RrnnError, ShapeError
from rrnn_opt.lyapunov import LyapunovFunction
from rrnn_opt.networks.primal_dual import PrimalDual
from rrnn_opt.symbolic import Box, Symbol

LAWS = settings(max_examples=25)
EPSILON = 0.1


def _feedback():
    kin = rr.Kinematics(rr.Robot.builtin("planar3"))
    form = rr.formulations.position_feedback(kin, epsilon=EPSILON)
    return kin, form, PrimalDual(EPSILON)(form)


KIN, FORM, NETWORK = _feedback()
ERROR = FORM.parameters[1].sx - KIN.position()


def _moving():
    """V = |J u|^2 / 2 + |e|^2 / 2 along (17) with q' = u: everything moves."""
    J = KIN.jacobian()
    value = (ca.sumsqr(J @ NETWORK.state.sx) + ca.sumsqr(ERROR)) / 2
    V = LyapunovFunction(value, NETWORK.state, NETWORK.parameters)
    rate = V.derivative(NETWORK, parameter_rates={"q": NETWORK.output})
    inputs = [NETWORK.state.sx, *(s.sx for s in NETWORK.parameters)]
    names = ["V", "rate", "f"]
    return ca.Function("v", inputs, [value, rate, NETWORK.derivative], [*"uqr"], names)


MOVING = _moving()
vectors = st.lists(st.floats(-0.8, 0.8), min_size=3, max_size=3).map(np.array)


@LAWS
@given(u=vectors, q=vectors, rd=vectors)
def test_derivative_against_finite_differences_along_the_flow(u, q, rd):
    _, rate, f = (np.asarray(x).ravel() for x in MOVING(u, q, rd))
    h = 1e-6
    ahead, behind = (
        float(MOVING(u + s * h * f, q + s * h * u, rd)[0]) for s in (1, -1)
    )
    assert rate[0] == pytest.approx((ahead - behind) / (2 * h), rel=1e-5, abs=1e-4)


@LAWS
@given(u=vectors, q=vectors, rd=vectors)
def test_the_printed_certificate_rises_under_17(u, q, rd):
    # V = e'e/2 along (17): its derivative is -e'J u, of either sign
    V = LyapunovFunction(ca.sumsqr(ERROR) / 2, NETWORK.state, NETWORK.parameters)
    rate = V.derivative(NETWORK, parameter_rates={"q": NETWORK.output})
    expected = -ca.dot(ERROR, KIN.jacobian() @ NETWORK.state.sx)
    f = ca.Function(
        "f", [NETWORK.state.sx, KIN.q, FORM.parameters[1].sx], [rate, expected]
    )
    one, other = (float(x) for x in f(u, q, rd))
    assert one == pytest.approx(other, rel=1e-9, abs=1e-12)
    back = float(f(-u, q, rd)[0])
    assert back == pytest.approx(-one, rel=1e-9, abs=1e-12)


def test_energy_of_the_frozen_second_order_law():
    # J and Omega frozen: V3 = |J u|^2/2 + sum of the integral of P(x) decays at
    # |J u|^2/epsilon; here with bounds inactive, where the integral is x^2/2
    J, e = Symbol.matrix("J", (2, 3)), Symbol.vector("e", 2)
    u = Symbol.vector("u", 3)
    pull = J.sx.T @ e.sx / EPSILON
    law = NeuralDynamics("law", u, (J, e), (pull - u.sx) / EPSILON, u.sx, pull - u.sx)
    value = ca.sumsqr(u.sx) / 2 + ca.sumsqr(e.sx) / (2 * EPSILON**2)
    V = LyapunovFunction(value, u, (e,))
    rate = V.derivative(law, parameter_rates={"e": -J.sx @ u.sx})
    expected = -ca.sumsqr(u.sx) / EPSILON
    gap = ca.Function("g", [u.sx, J.sx, e.sx], [rate - expected])
    rng = np.random.default_rng(0)
    for _ in range(20):
        inputs = rng.normal(size=3), rng.normal(size=(2, 3)), rng.normal(size=2)
        assert float(gap(*inputs)) == pytest.approx(0, abs=1e-10)


def test_derivative_of_the_reduced_law_is_19():
    # (18): e' = -J P(J'e/epsilon) gives (19), graph against graph
    e, J = Symbol.vector("e", 2), Symbol.matrix("J", (2, 3))
    P = Box(-np.ones(3), np.ones(3)).project(J.sx.T @ e.sx / EPSILON)
    law = NeuralDynamics("reduced", e, (J,), -J.sx @ P, e.sx, -J.sx @ P)
    rate = LyapunovFunction(ca.sumsqr(e.sx) / 2, e).derivative(law)
    f = ca.Function("f", [e.sx, J.sx], [rate, -ca.dot(J.sx.T @ e.sx, P)])
    rng = np.random.default_rng(1)
    for _ in range(20):
        one, other = f(rng.normal(size=2), rng.normal(size=(2, 3)))
        assert float(one) == pytest.approx(float(other), rel=1e-12)
        assert float(one) <= 0


def test_parameters_without_a_rate_stand_still():
    x, p = Symbol.scalar("x"), Symbol.scalar("p")
    law = NeuralDynamics("law", x, (p,), -x.sx, x.sx, x.sx)
    V = LyapunovFunction(x.sx * p.sx, x, (p,))
    f = ca.Function("f", [x.sx, p.sx], [V.derivative(law)])
    g = V.derivative(law, parameter_rates={"p": ca.SX(2)})
    g = ca.Function("g", [x.sx, p.sx], [g])
    assert float(f(3, 5)) == -15.0
    assert float(g(3, 5)) == -9.0


def test_a_parameter_is_the_one_of_the_dynamics():
    """Another symbol of that name would leave two different q in one derivative."""
    twin = Symbol.vector("q", KIN.robot.nv)
    value = ca.sumsqr(NETWORK.state.sx) * twin.sx[0]
    V = LyapunovFunction(value, NETWORK.state, (twin,))
    with pytest.raises(RrnnError, match="two symbols 'q'"):
        V.derivative(NETWORK, parameter_rates={"q": NETWORK.output})


def test_mistakes_are_named():
    x, p = Symbol.vector("x", 2), Symbol.vector("p", 2)
    law = NeuralDynamics("law", x, (p,), -x.sx, x.sx, x.sx)
    V = LyapunovFunction(ca.dot(x.sx, p.sx), x, (p,))
    with pytest.raises(ShapeError, match="V: expected"):
        LyapunovFunction(x.sx, x)
    with pytest.raises(RrnnError, match="V: depends on p_0"):
        LyapunovFunction(ca.dot(x.sx, p.sx), x)
    with pytest.raises(RrnnError, match="no parameter 'z'"):
        V.derivative(law, parameter_rates={"z": x.sx})
    for rate in (ca.SX(1), x.sx.T):
        with pytest.raises(ShapeError, match="rate of 'p'"):
            V.derivative(law, parameter_rates={"p": rate})
    with pytest.raises(RrnnError, match="rate of 'p': depends on z_0"):
        V.derivative(law, parameter_rates={"p": ca.SX.sym("z", 2)})
    other = Symbol.vector("x", 2)
    with pytest.raises(RrnnError, match="write V in dynamics"):
        LyapunovFunction(ca.sumsqr(other.sx), other).derivative(law)
