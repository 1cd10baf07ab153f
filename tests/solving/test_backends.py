import warnings
from functools import partial

import numpy as np
import pytest
import qpsolvers

from rrnn_opt.errors import ArgumentError, RrnnError
from rrnn_opt.solving.active_set import ActiveSet
from rrnn_opt.solving.backends import TIGHT, Qpsolvers
from rrnn_opt.solving.conic import CasadiConic
from rrnn_opt.solving.parts import OSQP_JUNK
from rrnn_opt.solving.protocol import Instance
from rrnn_opt.solving.sessions import DaqpSession, OsqpSession
from rrnn_opt.solving.status import Status

COARSE = ("highs", "ecos", "jaxopt_osqp")
"""Back ends that end at residuals of about 1e-7, whatever they are asked for."""

INSTALLED = [
    name for name in TIGHT if name in {*qpsolvers.available_solvers} - {*COARSE}
]


def instance(seed: int, *, stretch: float = 1.0) -> Instance:
    rng = np.random.default_rng(seed)
    n = 7
    A, G = rng.normal(size=(3, n)), rng.normal(size=(2, n))
    x = rng.uniform(-0.9, 0.9, n)
    # a zero that moves from problem to problem must not break the updates
    A[seed % 3, seed % n] = 0.0
    P = np.eye(n) + 0.1 * np.diag(rng.uniform(0, 1, n))
    P[0, 1] = P[1, 0] = rng.uniform(-0.2, 0.2)
    box = np.ones(n)
    b, q = A @ x * stretch, rng.normal(size=n)
    return Instance(qpsolvers.Problem(P, q, G, G @ x + 0.1, A, b, -box, box))


def solvers():
    sessions = [kind(mode=m) for kind in (OsqpSession, DaqpSession) for m in MODES]
    return sessions + [Qpsolvers(name) for name in INSTALLED]


MODES = ("warm", "cold")


KINDS = {
    "OsqpSession": OsqpSession,
    "DaqpSession": DaqpSession,
    "ActiveSet": ActiveSet,
    "Qpsolvers": partial(Qpsolvers, "osqp"),
    "CasadiConic": partial(CasadiConic, "osqp"),
}


@pytest.mark.parametrize("name", KINDS)
def test_a_misspelt_mode_is_refused(name):
    """It would run cold, and be called what it was misspelt to."""
    with pytest.raises(ArgumentError, match="'wram' is none of"):
        KINDS[name](mode="wram")


@pytest.mark.parametrize("solver", solvers(), ids=lambda s: f"{s.name}-{s.mode}")
def test_a_stream_with_an_infeasible_member(solver):
    """Every back end agrees with quadprog, and recovers after infeasibility."""
    for k in range(6):
        member = instance(k, stretch=50.0 if k == 3 else 1.0)
        if k == 0:
            solver.setup(member)
        else:
            solver.update(member)
        answer = solver.solve()
        if k == 3:
            assert answer.status is Status.PRIMAL_INFEASIBLE
            assert answer.x is None is answer.duals
            continue
        assert answer.status is Status.SOLVED, answer
        assert answer.residual.worst < 1e-9
        assert answer.time_s > 0.0
        truth = qpsolvers.solve_problem(member.problem, solver="quadprog")
        np.testing.assert_allclose(answer.x, truth.x, atol=1e-7)
        np.testing.assert_allclose(answer.duals.y, truth.y, atol=1e-6)
        np.testing.assert_allclose(answer.duals.z, truth.z, atol=1e-6)
        np.testing.assert_allclose(answer.duals.z_box, truth.z_box, atol=1e-6)


def test_the_base_install_has_two_solvers():
    assert {"osqp", "daqp"} <= set(INSTALLED)


def test_an_absent_solver_says_so():
    solver = Qpsolvers("no_such_solver")
    solver.setup(instance(0))
    answer = solver.solve()
    assert answer.status is Status.NOT_AVAILABLE
    assert "no_such_solver" in answer.message
    assert answer.x is None


def test_an_exception_becomes_a_status():
    solver = Qpsolvers("daqp", settings={"no_such_setting": 1})
    solver.setup(instance(0))
    answer = solver.solve()
    assert answer.status is Status.ERROR
    assert "no_such_setting" in answer.message


def test_loose_settings_are_found_out():
    solver = Qpsolvers("osqp", settings={"eps_abs": 1e-2, "eps_rel": 1e-2})
    solver.setup(instance(1))
    answer = solver.solve()
    assert answer.status is Status.NUMERICAL
    assert answer.x is None
    assert answer.residual.worst > 1e-3


def test_osqp_really_returns_junk_and_it_is_caught():
    """The reason for our own check; if this fails, OSQP has changed."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        raw = qpsolvers.solve_problem(
            instance(3, stretch=50.0).problem, solver="osqp", verbose=False
        )
    assert raw.x is not None
    assert (raw.x == OSQP_JUNK).all()


@pytest.mark.parametrize("solver", [Qpsolvers("daqp"), OsqpSession(), DaqpSession()])
def test_setup_comes_first(solver):
    with pytest.raises(RrnnError, match="setup"):
        solver.solve()


def test_bounds_and_rows_may_be_absent():
    free = Instance(qpsolvers.Problem(np.eye(2), np.array([1.0, -2.0])))
    for solver in (OsqpSession(), DaqpSession(), Qpsolvers("quadprog")):
        solver.setup(free)
        np.testing.assert_allclose(solver.solve().x, [-1.0, 2.0], atol=1e-9)
