import numpy as np
import pytest
import qpsolvers

import rrnn_opt as rr
from rrnn_opt.errors import RrnnError
from rrnn_opt.networks import PrimalDual

EPSILON = 0.02


@pytest.fixture(scope="module", params=["planar3", "pa10", "panda"])
def kin(request):
    return rr.Kinematics(rr.Robot.builtin(request.param))


def test_the_optimum_is_the_projected_pull(kin):
    form = rr.formulations.position_feedback(kin, epsilon=EPSILON)
    limits, rng = kin.robot.limits, np.random.default_rng(2)
    functions, dynamics = kin.functions(), PrimalDual(EPSILON)(form)
    clipped = 0
    for _ in range(10):
        q = limits.lower + (limits.upper - limits.lower) * rng.uniform(
            size=kin.robot.nv
        )
        tip = np.asarray(functions["position"](q)).ravel()
        rd = tip + rng.normal(scale=0.03, size=3)
        jacobian = np.asarray(functions["jacobian"](q))
        pull = jacobian.T @ (rd - tip) / EPSILON
        low = np.maximum(-0.5 * (q - limits.lower), -limits.velocity)
        high = np.minimum(-0.5 * (q - limits.upper), limits.velocity)
        expected = np.clip(pull, low, high)
        clipped += int(np.any(expected != pull))
        best = qpsolvers.solve_problem(form.qp.at(q=q, rd=rd), solver="daqp")
        np.testing.assert_allclose(best.x, expected, atol=1e-9)
        residual = dynamics.functions()["residual"](expected, q, rd)
        assert np.abs(np.asarray(residual)).max() < 1e-12
    assert clipped > 0


def test_it_has_no_rows_and_a_unit_hessian(kin):
    form = rr.formulations.position_feedback(kin)
    assert form.equalities.shape == form.inequalities.shape == (0, 1)
    np.testing.assert_array_equal(form.qp.hessian, np.eye(kin.robot.nv))
    assert [p.name for p in form.parameters] == ["q", "rd"]
    assert PrimalDual()(form).state.size == kin.robot.nv


@pytest.mark.parametrize("epsilon", [0.0, -0.1, np.nan, np.inf])
def test_epsilon_is_positive(kin, epsilon):
    with pytest.raises(RrnnError, match="positive and finite"):
        rr.formulations.position_feedback(kin, epsilon=epsilon)


def moving(kin, seed):
    """Posture, tip, Jacobian and a velocity that the arm can do slowly."""
    limits, rng = kin.robot.limits, np.random.default_rng(seed)
    share = rng.uniform(0.3, 0.7, kin.robot.nv)
    q = limits.lower + (limits.upper - limits.lower) * share
    functions = kin.functions()
    J = np.asarray(functions["jacobian"](q))
    rate = J @ rng.uniform(-0.02, 0.02, kin.robot.nv)
    return q, np.asarray(functions["position"](q)).ravel(), J, rate


def velocity(form, **given):
    return qpsolvers.solve_problem(form.qp.at(**given), solver="daqp").x


def test_without_feed_forward_the_law_lags_by_what_the_docstring_says(kin):
    form = rr.formulations.position_feedback(kin, epsilon=EPSILON)
    q, tip, J, rate = moving(kin, 4)
    lag = EPSILON * np.linalg.pinv(J @ J.T) @ rate
    np.testing.assert_allclose(J @ velocity(form, q=q, rd=tip + lag), rate, atol=1e-9)
    np.testing.assert_allclose(velocity(form, q=q, rd=tip), 0.0, atol=1e-12)


def test_feed_forward_keeps_pace_without_an_error(kin):
    settings = {"epsilon": EPSILON, "feed_forward": True, "damping": 1e-9}
    form = rr.formulations.position_feedback(kin, **settings)
    q, tip, J, rate = moving(kin, 4)
    u = velocity(form, q=q, rd=tip, rd_dot=rate)
    np.testing.assert_allclose(J @ u, rate, atol=1e-8)
    away = 0.001 * J @ np.ones(kin.robot.nv)
    u = velocity(form, q=q, rd=tip + away, rd_dot=rate)
    np.testing.assert_allclose(J @ u - rate, J @ J.T @ away / EPSILON, atol=1e-8)


def test_feed_forward_is_labelled_and_leaves_a_box_that_always_has_a_solution(kin):
    form = rr.formulations.position_feedback(kin, feed_forward=True)
    assert form.name == "position_feedback_feed_forward"
    assert form.inverse == "J J' + damping I"
    assert [p.name for p in form.parameters] == ["q", "rd", "rd_dot"]
    assert form.equalities.shape == (0, 1)
    q, tip, J, rate = moving(kin, 5)
    far = tip + 5.0 * J @ np.ones(kin.robot.nv)
    u = velocity(form, q=q, rd=far, rd_dot=rate)
    problem = form.qp.at(q=q, rd=far, rd_dot=rate)
    assert np.all((problem.lb - 1e-9 <= u) & (u <= problem.ub + 1e-9))
