import numpy as np
import qpsolvers

import rrnn_opt as rr
from rrnn_opt.formulations import closed_loop, quiet_posture

Q = np.deg2rad([0.0, 30.0, 0.0, 60.0, 0.0, 45.0, 0.0])


def solve(form, **given):
    return qpsolvers.solve_problem(form.qp.at(**given), solver="daqp").x


def test_self_motion_goes_to_where_noise_moves_the_tip_least():
    """At a bent posture the tip holds still and |J|_F falls; closed_loop rests."""
    kin = rr.Kinematics(rr.Robot.builtin("pa10"))
    functions = kin.functions()
    q = Q + np.array([0.0, 0.0, 0.4, 0.0, 0.3, 0.0, 0.0])
    tip = np.asarray(functions["position"](q)).ravel()
    given = {"q": q, "rd": tip, "rd_dot": np.zeros(3)}
    J = np.asarray(functions["jacobian"](q))
    u = solve(quiet_posture(kin), **given)
    np.testing.assert_allclose(J @ u, 0.0, atol=1e-8)
    after = np.asarray(functions["jacobian"](q + 1e-4 * u))
    assert np.sum(after**2) < np.sum(J**2) - 1e-6
    np.testing.assert_allclose(solve(closed_loop(kin), **given), 0.0, atol=1e-8)


def test_feedback_reaches_the_tip():
    kin = rr.Kinematics(rr.Robot.builtin("pa10"))
    functions = kin.functions()
    tip, J = (np.asarray(functions[k](Q)) for k in ("position", "jacobian"))
    aim, rate = np.array([0.01, -0.02, 0.005]), np.array([0.02, 0.01, -0.03])
    form = quiet_posture(kin, kappa=8.0)
    u = solve(form, q=Q, rd=tip.ravel() + aim, rd_dot=rate)
    np.testing.assert_allclose(J @ u, rate + 8.0 * aim, atol=1e-7)
