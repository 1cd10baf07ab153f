import numpy as np
import pytest

from rrnn_opt.errors import RrnnError
from rrnn_opt.formulations import closed_loop, minimum_velocity
from tests.formulations.points import data, jacobian, parameters, solve, tip

KAPPA = 7.0


def test_the_error_dies_out_at_the_rate_kappa(every):
    form = closed_loop(every, kappa=KAPPA)
    for seed in range(5):
        given = parameters(form, every, seed, size=0.02)
        J = jacobian(every, given["q"])
        error = given["rd"] - tip(every, given["q"])
        rate = given["rd_dot"] - J @ solve(form, given)  # e' = rd_dot - r'
        np.testing.assert_allclose(rate, -KAPPA * error, atol=1e-9)


def test_optimum_is_the_pseudoinverse_of_the_corrected_velocity(pa10):
    form = closed_loop(pa10, kappa=KAPPA)
    given = parameters(form, pa10, 1, size=0.02)
    J = jacobian(pa10, given["q"])
    asked = given["rd_dot"] + KAPPA * (given["rd"] - tip(pa10, given["q"]))
    np.testing.assert_allclose(solve(form, given), np.linalg.pinv(J) @ asked, atol=1e-9)


def test_the_feedback_is_all_that_parts_it_from_minimum_velocity(every):
    form, open_loop = closed_loop(every, kappa=KAPPA), minimum_velocity(every)
    given = parameters(form, every, 2)
    error = given["rd"] - tip(every, given["q"])
    ours = data(form, given)
    theirs = data(open_loop, {name: given[name] for name in ("q", "rd_dot")})
    np.testing.assert_allclose(ours.pop("b"), theirs.pop("b") + KAPPA * error)
    for name, value in ours.items():
        np.testing.assert_array_equal(value, theirs[name])


def test_a_pose_is_led_by_the_measured_error(pa10):
    form = closed_loop(pa10, kappa=KAPPA, task="pose")
    given = parameters(form, pa10, 3, size=0.02)
    assert [p.name for p in form.parameters] == ["q", "rd_dot", "error"]
    J = jacobian(pa10, given["q"], "pose")
    asked = given["rd_dot"] + KAPPA * given["error"]
    np.testing.assert_allclose(J @ solve(form, given), asked, atol=1e-9)


def test_kappa_is_positive(pa10):
    with pytest.raises(RrnnError, match=r"kappa 0\.0: it must be positive"):
        closed_loop(pa10, kappa=0.0)
