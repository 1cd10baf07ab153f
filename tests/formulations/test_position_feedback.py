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
