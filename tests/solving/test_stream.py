from types import SimpleNamespace

import casadi as ca
import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.errors import RrnnError, ShapeError
from rrnn_opt.solving import find_farkas, record_stream


@pytest.fixture(scope="module")
def motion(posture):
    s = np.linspace(0.0, 1.0, 101)[:, None]
    way = np.array([1.2, 0.5, -0.4, 0.7, 0.3, -0.5, 0.2])
    return SimpleNamespace(
        q=posture + (3 * s**2 - 2 * s**3) * way, qd=(6 * s - 6 * s**2) * way
    )


def test_the_stream_follows_the_motion(form, kin, motion):
    stream = record_stream(form, motion, kinematics=kin, count=11)
    assert len(stream) == 11
    assert stream.rows == tuple(range(0, 101, 10))
    jacobian = ca.Function("J", [kin.q], [kin.jacobian()])
    for row, scale, member in zip(
        stream.rows, stream.scales, stream.instances, strict=True
    ):
        np.testing.assert_array_equal(member.parameters["q"], motion.q[row])
        want = np.asarray(jacobian(motion.q[row]) @ (scale * motion.qd[row])).ravel()
        np.testing.assert_allclose(member.parameters["rd_dot"], want, atol=1e-14)


def test_the_motion_s_own_velocity_is_feasible(form, kin, motion):
    stream = record_stream(form, motion, kinematics=kin, count=21)
    assert min(stream.scales) < 0.9 < max(stream.scales) <= 1.0
    for row, scale, member in zip(
        stream.rows, stream.scales, stream.instances, strict=True
    ):
        u, qp = scale * motion.qd[row], member.problem
        assert (qp.lb - 1e-12 <= u).all()
        assert (u <= qp.ub + 1e-12).all()
        np.testing.assert_allclose(qp.A @ u, qp.b, atol=1e-12)
        assert find_farkas(qp) is None
        if scale < 1.0:
            slack = np.minimum(qp.ub - u, u - qp.lb)
            assert slack.min() == pytest.approx(0.0, abs=1e-12)


def test_a_target_is_where_the_motion_ends(kin, motion):
    form = rr.formulations.position_feedback(kin)
    stream = record_stream(form, motion, kinematics=kin, count=3)
    end = np.asarray(ca.Function("p", [kin.q], [kin.position()])(motion.q[-1]))
    for member in stream.instances:
        assert set(member.parameters) == {"q", "rd"}
        np.testing.assert_allclose(member.parameters["rd"], end.ravel())


def test_a_short_motion_gives_each_row_once(form, kin, motion):
    short = SimpleNamespace(q=motion.q[:2], qd=motion.qd[:2])
    assert record_stream(form, short, kinematics=kin).rows == (0, 1)


def test_shapes_are_checked(form, kin, motion):
    with pytest.raises(ShapeError, match=r"motion\.q:"):
        record_stream(
            form, SimpleNamespace(q=motion.q[:, :3], qd=motion.qd), kinematics=kin
        )
    with pytest.raises(ShapeError, match=r"motion\.qd"):
        record_stream(
            form, SimpleNamespace(q=motion.q, qd=motion.qd[:3]), kinematics=kin
        )


def test_an_unknown_parameter_is_named(kin, motion):
    u = rr.Symbol.vector("u", 7, "rad/s", "")
    odd = rr.Symbol.vector("odd", 1, "1", "")
    form = rr.Formulation(
        name="odd_one",
        decision=u,
        parameters=(odd,),
        cost=ca.dot(u.sx, u.sx) + odd.sx,
    )
    with pytest.raises(RrnnError, match="'odd'"):
        record_stream(form, motion, kinematics=kin)
