from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import qpsolvers

from rrnn_opt.errors import ArgumentError
from rrnn_opt.solving import (
    DaqpSession,
    Instance,
    OsqpSession,
    Qpsolvers,
    SettledNetwork,
    Status,
    Stream,
    Tolerances,
    compare,
    record_stream,
)
from rrnn_opt.solving.compare import multipliers_unique


@pytest.fixture(scope="module")
def stream(form, kin, posture):
    s = np.linspace(0.0, 1.0, 101)[:, None]
    way = np.array([0.3, 1.0, 0.0, 0.6, 0.0, -0.5, 0.0])
    motion = SimpleNamespace(
        q=posture + (3 * s**2 - 2 * s**3) * way, qd=(6 * s - 6 * s**2) * way
    )
    return record_stream(form, motion, kinematics=kin)


@pytest.mark.parametrize("mode", ["warm", "cold"])
def test_network_osqp_and_daqp_agree_along_a_motion(network, stream, mode):
    solvers = [SettledNetwork(network, mode), OsqpSession(mode), DaqpSession(mode)]
    rows = compare(stream, solvers)
    assert len(rows) == 3 * len(stream) == 120
    assert all(row.agrees for row in rows)
    assert all(row.status is Status.SOLVED for row in rows)
    assert max(row.primal for row in rows) < 1e-7
    assert max(row.equality for row in rows) < 1e-6
    assert max(row.box for row in rows) < 1e-6
    assert max(row.residual.worst for row in rows) < 1e-8
    bounds = [np.abs(solve(m).z_box).max() for m in stream.instances]
    assert np.count_nonzero(np.array(bounds) > 1e-3) > 3


def solve(member):
    return qpsolvers.solve_problem(member.problem, solver="quadprog")


class Liar(DaqpSession):
    """Moves the answer a little and keeps the good word."""

    def solve(self):
        answer = super().solve()
        return replace(answer, x=answer.x + 1e-4)


class DualLiar(DaqpSession):
    def solve(self):
        answer = super().solve()
        return replace(answer, duals=replace(answer.duals, y=-answer.duals.y))


@pytest.mark.parametrize("liar", [Liar, DualLiar])
def test_a_wrong_answer_is_seen(stream, liar):
    rows = compare(stream, [DaqpSession(), liar()])
    wrong = [row for row in rows if not row.agrees]
    # the first and last QP are at rest: there y = -y = 0
    assert len(wrong) >= len(stream) - 2
    assert {row.index for row in wrong} >= set(range(1, len(stream) - 1))


def test_tolerances_are_the_caller_s(network, stream):
    solvers = [SettledNetwork(network), DaqpSession()]
    rows = compare(stream, solvers, tolerances=Tolerances(primal=1e-18))
    assert not all(row.agrees for row in rows)


def one(problem) -> Stream:
    return Stream("one", (Instance(problem),), (0,), (1.0,))


def test_agreement_on_infeasibility_is_agreement():
    A = np.ones((1, 2))
    box = np.ones(2)
    problem = qpsolvers.Problem(
        np.eye(2), np.zeros(2), A=A, b=np.array([5.0]), lb=-box, ub=box
    )
    rows = compare(one(problem), [DaqpSession(), OsqpSession()])
    assert all(row.agrees for row in rows)
    assert all(row.status is Status.PRIMAL_INFEASIBLE for row in rows)
    assert all(np.isnan(row.primal) for row in rows)


def test_what_is_no_solver_and_no_tolerance_is_refused(network, stream):
    with pytest.raises(ArgumentError, match="'osqp' has no setup"):
        compare(stream, [DaqpSession(), "osqp"])
    with pytest.raises(ArgumentError, match="at least 0"):
        Tolerances(dual=-1.0)
    with pytest.raises(ArgumentError, match="'hot' is none of"):
        SettledNetwork(network, "hot")


def test_a_missing_solver_does_not_agree():
    problem = qpsolvers.Problem(np.eye(2), np.zeros(2))
    rows = compare(one(problem), [DaqpSession(), Qpsolvers("no_such_solver")])
    assert [row.agrees for row in rows] == [True, False]
    assert rows[1].status is Status.NOT_AVAILABLE


def test_multipliers_that_are_not_unique_are_not_compared():
    """The same row twice: only the sum of the two multipliers is fixed."""
    A = np.array([[1.0, 1.0], [1.0, 1.0]])
    problem = qpsolvers.Problem(np.eye(2), np.zeros(2), A=A, b=np.array([1.0, 1.0]))
    tight = {"eps_abs": 1e-10, "eps_rel": 0.0}
    rows = compare(one(problem), [OsqpSession(settings=tight), Qpsolvers("piqp")])
    assert all(row.agrees for row in rows)
    assert np.isnan(rows[1].equality)


def test_too_many_active_bounds_leave_no_unique_multipliers():
    A = np.array([[1.0, 1.0]])
    box = np.ones(2)
    problem = qpsolvers.Problem(
        np.eye(2), np.zeros(2), A=A, b=np.array([2.0]), lb=-box, ub=box
    )
    solver = DaqpSession()
    solver.setup(Instance(problem))
    answer = solver.solve()
    assert answer.status is Status.SOLVED
    assert not multipliers_unique(Instance(problem), answer)


def test_daqp_streams_qps_without_rows():
    """A box alone: DAQP itself reads beyond the empty matrix."""
    from qpsolvers import Problem

    from rrnn_opt.solving import DaqpSession, Instance, Status

    solver, one = DaqpSession(), np.ones(2)
    for k, q in enumerate(([1.0, 0.0], [-3.0, 0.5])):
        problem = Problem(np.eye(2), np.array(q), lb=-one, ub=one)
        (solver.update if k else solver.setup)(Instance(problem))
        answer = solver.solve()
        assert answer.status is Status.SOLVED
        np.testing.assert_allclose(answer.x, np.clip(-np.array(q), -1, 1), atol=1e-12)
