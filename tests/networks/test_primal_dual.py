import casadi as ca
import numpy as np
import pytest
import qpsolvers

import rrnn_opt as rr
from rrnn_opt.dynamics import Euler
from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks import PrimalDual
from rrnn_opt.symbolic import Box, Symbol

u = Symbol.vector("u", 3)
rd_dot = Symbol.vector("rd_dot", 2)
J = np.array([[1.0, 0.5, -0.25], [0.0, 1.0, 0.75]])


def tracking(W, *, bound=0.4, inequalities=None):
    return Formulation(
        name="tracking",
        decision=u,
        parameters=(rd_dot,),
        cost=ca.bilin(ca.SX(ca.sparsify(ca.DM(W))), u.sx, u.sx),
        equalities=rd_dot.sx - ca.SX(J) @ u.sx,
        inequalities=inequalities,
        lower=-bound * ca.SX.ones(3),
        upper=bound * ca.SX.ones(3),
    )


def function(dynamics, expr):
    symbols = (dynamics.state, *dynamics.parameters)
    return ca.Function("f", [s.sx for s in symbols], [expr])


def test_equation_6_by_hand():
    W = np.diag([1.0, 2.0, 0.5])
    dynamics = PrimalDual(0.02)(tracking(W))
    rng = np.random.default_rng(0)
    for _ in range(10):
        velocity, lam, rate = rng.normal(size=3), rng.normal(size=2), rng.normal(size=2)
        gradient = 2 * W @ velocity - J.T @ lam
        first = (-velocity + np.clip(velocity - gradient, -0.4, 0.4)) / 0.02
        second = (rate - J @ velocity) / 0.02
        state = np.concatenate([velocity, lam])
        made = dynamics.functions()["derivative"](state, rate)
        expected = np.concatenate([first, second])
        np.testing.assert_allclose(np.asarray(made).ravel(), expected, rtol=1e-12)


def test_the_drive_is_that_of_16_only_for_half_the_identity():
    # (16) has P(J'lambda); with (8) as printed, W = I, it is P(J'lambda - u)
    lam = Symbol.vector("lam", 2)
    half = tracking(np.eye(3) / 2, bound=np.inf)
    whole = tracking(np.eye(3), bound=np.inf)
    for form, expected in ((half, J.T @ lam.sx), (whole, J.T @ lam.sx - u.sx)):
        drive = form.lagrangian.drive
        own = form.lagrangian.equality_dual.sx
        gap = ca.Function("g", [u.sx, own, lam.sx], [drive - expected])
        value = np.array([0.3, -0.7])
        np.testing.assert_allclose(gap([1, 2, 3], value, value), 0, atol=1e-15)


def settle(dynamics, start, given, *, h, steps):
    step = dynamics.step(Euler(h)).functions()["step"]
    state, p = ca.SX.sym("x", len(start)), ca.SX.sym("p", len(given))
    loop = ca.Function("s", [state, p], [step(state, p)[0]]).mapaccum(steps)
    final = loop(start, ca.repmat(ca.DM(given), 1, steps))
    return np.asarray(final[:, -1]).ravel()


@pytest.mark.parametrize("target", [[0.1, 0.2], [0.45, 0.55], [-0.3, 0.4]])
def test_the_network_settles_at_the_solvers_optimum(target):
    form = tracking(np.eye(3) / 2)
    dynamics = PrimalDual(0.01)(form)
    best = qpsolvers.solve_problem(form.qp.at(rd_dot=target), solver="daqp")
    state = settle(dynamics, np.zeros(5), target, h=0.001, steps=3000)
    np.testing.assert_allclose(state[:3], best.x, atol=1e-9)
    functions = dynamics.functions()
    assert np.abs(np.asarray(functions["residual"](state, target))).max() < 1e-9
    rows, bounds = functions["duals"](state, target)
    np.testing.assert_allclose(np.asarray(rows).ravel(), -best.y, atol=1e-6)
    np.testing.assert_allclose(np.asarray(bounds).ravel(), best.z_box, atol=1e-6)


def test_inequality_rows_settle_too():
    rows = ca.vertcat(u.sx[0] - 0.05, -u.sx[1] - 9)
    form = tracking(np.eye(3) / 2, inequalities=rows)
    dynamics = PrimalDual(0.01)(form)
    target = [0.3, 0.1]
    best = qpsolvers.solve_problem(form.qp.at(rd_dot=target), solver="daqp")
    assert best.z[0] > 0.01
    state = settle(dynamics, np.zeros(7), target, h=0.001, steps=6000)
    np.testing.assert_allclose(state[:3], best.x, atol=1e-8)
    assert set(dynamics.duals()) == {"lam", "mu", "z_box"}
    _, mu, _ = dynamics.functions()["duals"](state, target)
    np.testing.assert_allclose(np.asarray(mu).ravel(), best.z, atol=1e-6)


def test_a_semidefinite_weight_circles_for_ever():
    # W = 0, J = 1: eigenvalues +-i/epsilon, so no convergence is promised
    v, r = Symbol.scalar("v"), Symbol.scalar("r")
    form = Formulation("t", v, (r,), cost=ca.SX(0), equalities=r.sx - v.sx)
    dynamics = PrimalDual(0.1)(form)
    slope = ca.jacobian(dynamics.derivative, dynamics.state.sx)
    modes = np.linalg.eigvals(np.asarray(ca.DM(ca.densify(slope))))
    np.testing.assert_allclose(sorted(modes.imag), [-10.0, 10.0])
    np.testing.assert_allclose(modes.real, 0.0, atol=1e-12)


@pytest.mark.parametrize("robot", ["planar3", "pa10", "panda", "raven2"])
@pytest.mark.parametrize("epsilon", [0.01, 0.3])
def test_network_of_the_position_feedback_is_exactly_17(robot, epsilon):
    kin = rr.Kinematics(rr.Robot.builtin(robot))
    form = rr.formulations.position_feedback(kin, epsilon=epsilon)
    dynamics = PrimalDual(epsilon)(form)
    q, rd = form.parameters
    assert dynamics.state is form.decision
    pull = kin.jacobian().T @ ((rd.sx - kin.position()) / epsilon)
    P = Box(form.lower, form.upper).project(pull)
    by_hand = (P - form.decision.sx) / epsilon  # (17)
    inputs = [form.decision.sx, q.sx, rd.sx]
    names = ["u", "q", "rd"]
    ours, written = (
        rr.symbolic.fingerprint(ca.Function("f", inputs, [expr], names, ["f"]))
        for expr in (dynamics.derivative, by_hand)
    )
    assert ours == written


@pytest.mark.parametrize("epsilon", [0.0, -1.0, np.nan, np.inf])
def test_epsilon_is_positive(epsilon):
    with pytest.raises(RrnnError, match="positive and finite"):
        PrimalDual(epsilon)


def test_without_bounds_there_are_no_bound_duals():
    dynamics = PrimalDual()(Formulation("t", u, (), cost=ca.sumsqr(u.sx - 1)))
    assert dynamics.duals() == {}
    assert (
        np.asarray(dynamics.functions()["residual"](np.ones(3))).tolist() == [[0.0]] * 3
    )


def test_output_is_the_decision_and_the_formulation_is_kept():
    form = tracking(np.eye(3) / 2)
    dynamics = PrimalDual()(form)
    assert dynamics.formulation is form
    value = function(dynamics, dynamics.output)([1, 2, 3, 4, 5], [0, 0])
    assert np.asarray(value).ravel().tolist() == [1.0, 2.0, 3.0]


@pytest.mark.parametrize(
    "weight", [np.eye(3) / 2, np.diag([1.0, 0.3, 0.2]), np.diag([5.0, 4.0, 3.0])]
)
@pytest.mark.parametrize("whiten", [False, True])
def test_no_mode_grows_within_the_bound(weight, whiten):
    """At any state, whatever is active there; beyond it one does somewhere."""
    rows = ca.vertcat(u.sx[0] - 0.05, u.sx[1] + u.sx[2])
    form = tracking(weight, inequalities=rows)
    rule = PrimalDual(0.01, whiten=whiten)
    dynamics, rng = rule(form), np.random.default_rng(0)
    slope = function(dynamics, ca.jacobian(dynamics.derivative, dynamics.state.sx))
    h = rule.euler_bound(form, rd_dot=[0.1, 0.2])
    assert h > 0.0
    worst = 0.0
    for _ in range(200):
        state = rng.normal(size=7) * rng.choice([0.1, 1.0])
        modes = np.linalg.eigvals(np.asarray(slope(state, [0.1, 0.2])))
        assert np.abs(1.0 + h * modes).max() <= 1.0 + 1e-9
        worst = max(worst, np.abs(1.0 + 2.5 * h * modes).max())
    assert worst > 1.0


def test_the_bound_is_that_of_the_free_modes():
    """P = I, sigma the largest singular value of J: h = eps / sigma^2."""
    form = tracking(np.eye(3) / 2)
    sigma = np.linalg.norm(J, 2)
    bound = PrimalDual(0.01).euler_bound(form, rd_dot=[0, 0])
    assert bound == pytest.approx(min(0.02, 0.01 / sigma**2))
    assert PrimalDual().euler_bound(tracking(np.zeros((3, 3))), rd_dot=[0, 0]) == 0.0
