from dataclasses import replace

import casadi as ca
import numpy as np
import pytest
import qpsolvers
from hypothesis import given, settings
from hypothesis import strategies as st

import rrnn_opt as rr
from rrnn_opt.errors import NotFiniteError, RrnnError, ShapeError
from rrnn_opt.solving import Status, settle


def truth(form, **params):
    return qpsolvers.solve_problem(form.qp.at(**params), solver="quadprog")


@given(seed=st.integers(0, 1000))
@settings(max_examples=15)
def test_the_equilibrium_is_the_optimum_with_its_multipliers(
    form, network, posture, seed
):
    rng = np.random.default_rng(seed)
    q = posture + rng.uniform(-0.3, 0.3, 7)
    v = rng.normal(size=3) * 0.2
    x, info = settle(network, q=q, rd_dot=v)
    want = truth(form, q=q, rd_dot=v)
    if want.x is None:
        assert x is None
        assert info.status is Status.PRIMAL_INFEASIBLE
        return
    assert info.status is Status.SOLVED
    assert info.kkt_residual <= 1e-8
    np.testing.assert_allclose(x, want.x, atol=1e-6)
    np.testing.assert_allclose(info.duals["equality"], -want.y, atol=1e-5)
    np.testing.assert_allclose(info.duals["box"], want.z_box, atol=1e-5)
    assert info.duals["inequality"].shape == (0,)


def test_active_bounds_are_settled_too(form, network, posture):
    v = np.array([0.3, 0.4, 0.1])
    x, info = settle(network, q=posture, rd_dot=v)
    want = truth(form, q=posture, rd_dot=v)
    assert np.abs(want.z_box).max() > 0.1
    np.testing.assert_allclose(x, want.x, atol=1e-7)
    np.testing.assert_allclose(info.duals["box"], want.z_box, atol=1e-6)


def test_an_infeasible_programme_gives_no_point(network, posture):
    x, info = settle(network, q=posture, rd_dot=[10.0, 0.0, 0.0], max_steps=5000)
    assert x is None
    assert info.status is Status.PRIMAL_INFEASIBLE
    assert info.duals == {}
    assert info.kkt_residual > 1.0


def test_a_position_outside_its_limits_is_an_empty_bound(network, posture):
    q = posture.copy()
    q[1] = 5.0
    x, info = settle(network, q=q, rd_dot=np.zeros(3))
    assert x is None
    assert info.status is Status.PRIMAL_INFEASIBLE
    assert "bound 1 is empty" in info.message
    assert info.steps == 0


def test_too_few_steps_say_so(network, posture):
    given = {"q": posture, "rd_dot": [0.1, 0.0, 0.0], "max_steps": 3}
    x, info = settle(network, newton=False, **given)
    assert x is None
    assert info.status is Status.MAX_ITER
    x, info = settle(network, **given)
    assert info.status is Status.SOLVED
    assert info.newton > 0


def test_newton_finishes_what_the_network_alone_cannot(form, network, posture):
    """An elbow almost stretched: sigma_min of J is a thousandth."""
    q = posture.copy()
    q[[3, 5]] = 1e-3
    given = {"q": q, "rd_dot": np.array([1e-4, 0.0, 1.7e-4])}
    x, info = settle(network, newton=False, max_steps=20_000, **given)
    assert x is None
    x, info = settle(network, **given)
    assert info.status.has_point
    assert info.newton > 0
    assert "Newton" in info.message
    want = truth(form, q=q, rd_dot=given["rd_dot"])
    np.testing.assert_allclose(x, want.x, atol=1e-7)
    scale = np.abs(want.y).max()
    np.testing.assert_allclose(info.duals["equality"], -want.y, atol=1e-6 * scale)


def test_a_bad_warm_start_is_forgotten(form, network, posture):
    v = [0.3, 0.4, 0.1]
    start = np.full(10, 1e8)
    x, _ = settle(network, q=posture, rd_dot=v, start=start, newton=False)
    np.testing.assert_allclose(x, truth(form, q=posture, rd_dot=v).x, atol=1e-6)


def test_a_step_that_diverges_is_shortened(form, network, posture):
    v = [0.1, 0.0, 0.1]
    x, info = settle(network, q=posture, rd_dot=v, step=0.05)
    assert info.step < 0.05
    np.testing.assert_allclose(x, truth(form, q=posture, rd_dot=v).x, atol=1e-7)


def test_a_warm_start_saves_steps(network, posture):
    v = np.array([0.1, 0.0, 0.1])
    _, cold = settle(network, q=posture, rd_dot=v)
    _, warm = settle(network, q=posture, rd_dot=1.001 * v, start=cold.state)
    assert warm.status is Status.SOLVED
    assert warm.steps < 0.8 * cold.steps


def test_inequality_rows_and_another_weight(kin, posture):
    """A formulation with every part: rows, bounds and a Hessian that is not I."""
    u = rr.Symbol.vector("u", 3, "1", "decision")
    p = rr.Symbol.vector("p", 2, "1", "parameter")
    weight = ca.DM([[2.0, 0.3, 0.0], [0.3, 1.0, 0.1], [0.0, 0.1, 0.7]])
    form = rr.Formulation(
        name="every_part",
        decision=u,
        parameters=(p,),
        cost=ca.bilin(ca.SX(weight), u.sx, u.sx) / 2 + p.sx[1] * u.sx[0],
        equalities=p.sx[0] - ca.sum1(u.sx),
        inequalities=u.sx[2] - u.sx[1] + 0.05,
        lower=ca.SX([-1.0, -1.0, -1.0]),
        upper=ca.SX([1.0, 1.0, 0.6]),
    )
    network = rr.networks.PrimalDual(epsilon=0.02)(form)
    given = {"p": np.array([1.5, -0.4])}
    x, info = settle(network, **given)
    want = truth(form, **given)
    assert want.z[0] > 0.01
    np.testing.assert_allclose(x, want.x, atol=1e-7)
    np.testing.assert_allclose(info.duals["inequality"], want.z, atol=1e-6)
    np.testing.assert_allclose(info.duals["equality"], -want.y, atol=1e-6)


def test_position_feedback_is_a_projection(kin, posture):
    form = rr.formulations.position_feedback(kin, epsilon=0.02)
    network = rr.networks.PrimalDual(epsilon=0.02)(form)
    rd = np.array([0.75, 0.05, 0.66])
    x, info = settle(network, q=posture, rd=rd)
    problem = form.qp.at(q=posture, rd=rd)
    np.testing.assert_allclose(x, np.clip(-problem.q, problem.lb, problem.ub))
    assert info.duals["equality"].shape == (0,)


def test_bad_parameters_are_named(network, posture):
    with pytest.raises(RrnnError, match="'rd_dot' is missing"):
        settle(network, q=posture)
    with pytest.raises(ShapeError, match="rd_dot"):
        settle(network, q=posture, rd_dot=[0.0])
    with pytest.raises(NotFiniteError, match="rd_dot"):
        settle(network, q=posture, rd_dot=[np.nan, 0.0, 0.0])


@pytest.mark.parametrize("bad", [{"step": 0.0}, {"step": -1.0}, {"tolerance": 0.0}])
def test_a_step_or_tolerance_that_is_not_positive_is_refused(network, posture, bad):
    with pytest.raises(RrnnError, match="give positive ones"):
        settle(network, q=posture, rd_dot=[0.0, 0.0, 0.0], **bad)


def test_a_network_without_a_formulation_is_refused():
    x = rr.Symbol.vector("x", 1, "1", "state")
    bare = rr.NeuralDynamics(
        name="bare",
        state=x,
        parameters=(),
        derivative=-x.sx,
        output=x.sx,
        residual=x.sx,
    )
    with pytest.raises(RrnnError, match="formulation"):
        settle(bare)


def test_top_level_verb():
    assert rr.settle is settle


def test_a_formulation_alone_is_settled_over_whitened_rows(form, network, posture):
    v = np.array([0.1, 0.0, 0.1])
    x, info = settle(form, q=posture, rd_dot=v)
    want = truth(form, q=posture, rd_dot=v)
    np.testing.assert_allclose(x, want.x, atol=1e-7)
    np.testing.assert_allclose(info.duals["equality"], -want.y, atol=1e-6)
    _, plain = settle(network, q=posture, rd_dot=v)
    assert info.steps < plain.steps / 3


def test_a_map_runs_by_its_own_step(form, posture):
    v = np.array([0.3, 0.4, 0.1])
    x, info = settle(rr.networks.Lvi94()(form), q=posture, rd_dot=v, step=0.3)
    np.testing.assert_allclose(x, truth(form, q=posture, rd_dot=v).x, atol=1e-7)
    again, other = settle(rr.networks.Lvi94()(form), q=posture, rd_dot=v)
    np.testing.assert_array_equal(x, again)
    assert info.steps == other.steps


def test_a_map_that_does_not_settle_is_not_tried_again(form, posture):
    law, v = rr.networks.Lvi94()(form), np.array([0.3, 0.4, 0.1])
    x, info = settle(law, q=posture, rd_dot=v, max_steps=7, newton=False)
    assert x is None
    assert (info.status, info.steps) == (Status.MAX_ITER, 7)


def test_a_network_that_is_told_rates_settles_with_data_that_stand_still(form, posture):
    free = replace(form, lower=None, upper=None)
    v = np.array([0.1, 0.0, 0.1])
    x, info = settle(rr.networks.Znn()(free), q=posture, rd_dot=v)
    want = qpsolvers.solve_problem(free.qp.at(q=posture, rd_dot=v), solver="quadprog")
    np.testing.assert_allclose(x, want.x, atol=1e-7)
    assert info.steps <= 5


def test_a_run_begins_where_the_network_says(form, posture):
    """Zero is outside the bounds here; the network begins at the nearest u."""
    moved = replace(
        form, lower=ca.SX.ones(7) / 10, upper=ca.SX.ones(7), equalities=None
    )
    law = rr.networks.PrimalDual()(moved)
    x, info = settle(law, q=posture, rd_dot=np.zeros(3), tolerance=1e-12)
    np.testing.assert_allclose(x, 0.1)
    assert info.steps == 0


@pytest.mark.parametrize("start", [[], [0.0], np.zeros((2, 2)), np.zeros(1000)])
def test_a_start_that_is_no_state_of_the_network_is_refused(form, network, start):
    with pytest.raises(ShapeError, match="start"):
        settle(network, start=start, q=np.zeros(7), rd_dot=np.zeros(3))
