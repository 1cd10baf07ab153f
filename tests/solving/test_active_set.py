"""The controller's exact solver against DAQP, quadprog and proofs of infeasibility."""

from __future__ import annotations

import numpy as np
import pytest
import qpsolvers
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.errors import RrnnError
from rrnn_opt.solving import ActiveSet, DaqpSession, Instance, Status
from rrnn_opt.solving.active_set import INFEASIBLE, SOLVED, solve_dense
from rrnn_opt.solving.parts import Dense
from rrnn_opt.solving.residual import kkt_residual
from tests.catalogue import form, kinematics, schemes
from tests.formulations.points import parameters

SIZES = [(1, 0, 0), (3, 1, 0), (7, 3, 2), (7, 6, 4), (6, 0, 8)]


def random_problem(rng, n, p, m, *, box=1.0):
    """A strictly convex programme that the point x solves up to its cost."""
    root = rng.normal(size=(n, n))
    x = rng.uniform(-box, box, n)
    A, G = rng.normal(size=(p, n)), rng.normal(size=(m, n))
    slack = rng.uniform(0.0, 0.3, m) * rng.integers(0, 2, m)
    return qpsolvers.Problem(
        P=root @ root.T + 0.1 * np.eye(n),
        q=4.0 * rng.normal(size=n),
        A=A if p else None,
        b=A @ x if p else None,
        G=G if m else None,
        h=G @ x + slack if m else None,
        lb=np.full(n, -box),
        ub=np.full(n, box),
    )


def difference(problem):
    """Largest distance in x from DAQP; None when DAQP finds nothing."""
    best = qpsolvers.solve_problem(
        problem, solver="daqp", primal_tol=1e-11, dual_tol=1e-12
    )
    if not best.found:
        return None
    raw = solve_dense(Dense.of(problem))
    assert raw.status == SOLVED
    return float(np.abs(raw.x - best.x).max())


@pytest.mark.parametrize("size", SIZES)
def test_random_programmes_are_solved_like_daqp(size):
    rng = np.random.default_rng(sum(size))
    worst = [difference(random_problem(rng, *size)) for _ in range(80)]
    found = [gap for gap in worst if gap is not None]
    assert len(found) >= 79
    assert max(found) <= 1e-6


def catalogue_gaps(robot, count):
    """(differences from DAQP, wrong refusals) over every scheme of a robot."""
    gaps, wrong = [], []
    for scheme in schemes():
        declared = form(robot, scheme)
        for seed in range(count):
            size = (0.05, 1.2, 2.0)[seed % 3]
            values = parameters(declared, kinematics(robot), seed, size=size)
            try:
                problem = declared.qp.at(**values)
            except RrnnError:
                continue
            qp = Dense.of(problem)
            raw = solve_dense(qp)
            best = DaqpSession(mode="cold")
            best.setup(Instance(problem))
            answer = best.solve()
            if answer.status is Status.SOLVED:
                if raw.status != SOLVED:
                    wrong.append((str(scheme), seed, raw.status))
                elif np.linalg.eigvalsh(qp.P)[0] > 1e-6:
                    gaps.append(float(np.abs(raw.x - answer.x).max()))
                else:  # x need not be unique
                    gaps.append(kkt_residual(qp, raw.x, raw.duals).worst)
            elif answer.status is Status.PRIMAL_INFEASIBLE and raw.status == SOLVED:
                wrong.append((str(scheme), seed, "solved the infeasible"))
    return gaps, wrong


def test_every_scheme_is_solved_like_daqp():
    gaps, wrong = catalogue_gaps("planar3", 3)
    assert not wrong
    assert len(gaps) > 40
    assert max(gaps) <= 1e-6


@pytest.mark.slow
@pytest.mark.parametrize("robot", ["planar3", "pa10"])
def test_thousands_of_programmes_are_solved_like_daqp(robot):
    gaps, wrong = catalogue_gaps(robot, 60)
    assert not wrong
    assert len(gaps) > 1000
    assert max(gaps) <= 1e-6


@settings(max_examples=60)
@given(st.integers(0, 2**32 - 1), st.sampled_from(SIZES))
def test_its_multipliers_satisfy_the_kkt_conditions(seed, size):
    problem = Dense.of(random_problem(np.random.default_rng(seed), *size))
    raw = solve_dense(problem)
    assert raw.status == SOLVED
    assert np.all((problem.lb <= raw.x) & (raw.x <= problem.ub))
    assert kkt_residual(problem, raw.x, raw.duals).worst <= 1e-7


def small(**parts):
    n = 2
    wanted = {"P": np.eye(n), "q": np.array([-1.0, -2.0])} | parts
    return Dense.of(qpsolvers.Problem(**wanted))


@pytest.mark.parametrize(
    ("parts", "point"),
    [
        # the same equality twice, one of them scaled
        ({"A": np.array([[1.0, 1.0], [2.0, 2.0]]), "b": np.ones(2) * [1, 2]}, (0, 1)),
        # an equality of zeros
        (
            {"A": np.array([[0.0, 0.0], [1.0, 0.0]]), "b": np.array([0.0, 0.5])},
            (0.5, 2),
        ),
        # a vertex at which three rows meet
        (
            {
                "G": np.array([[1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]),
                "h": np.array([0.5, 0.5, 1.0]),
            },
            (0.5, 0.5),
        ),
        # the same inequality thrice
        ({"G": np.ones((3, 2)), "h": np.ones(3)}, (0.0, 1.0)),
        # a bound that fixes
        ({"lb": np.array([0.3, -9.0]), "ub": np.array([0.3, 9.0])}, (0.3, 2.0)),
        # no bounds at all
        ({"lb": np.full(2, -np.inf), "ub": np.full(2, np.inf)}, (1.0, 2.0)),
    ],
)
def test_degenerate_programmes_have_their_answer(parts, point):
    raw = solve_dense(small(**parts))
    assert raw.status == SOLVED
    np.testing.assert_allclose(raw.x, point, atol=1e-9)


@pytest.mark.parametrize(
    "parts",
    [
        {"A": np.array([[1.0, 1.0], [1.0, 1.0]]), "b": np.array([1.0, 2.0])},
        {"A": np.zeros((1, 2)), "b": np.array([1.0])},
        {"G": np.array([[1.0, 0.0], [-1.0, 0.0]]), "h": np.array([-1.0, -1.0])},
        {"lb": np.array([1.0, 0.0]), "ub": np.array([0.5, 1.0])},
        {
            "A": np.ones((1, 2)),
            "b": np.array([5.0]),
            "lb": -np.ones(2),
            "ub": np.ones(2),
        },
    ],
)
def test_contradictions_are_said(parts):
    assert solve_dense(small(**parts)).status == INFEASIBLE


def test_a_linear_cost_is_solved_by_proximal_rounds():
    problem = small(P=np.zeros((2, 2)), lb=-np.ones(2), ub=np.array([2.0, 3.0]))
    raw = solve_dense(problem)
    assert raw.status == SOLVED
    np.testing.assert_allclose(raw.x, [2.0, 3.0], atol=1e-9)


def test_it_is_a_solver_like_the_others():
    rng = np.random.default_rng(4)
    solver, problem = ActiveSet(), random_problem(rng, 7, 3, 2)
    with pytest.raises(RrnnError, match="setup"):
        solver.solve()
    solver.setup(Instance(problem))
    assert solver.solve().status is Status.SOLVED
    solver.update(Instance(random_problem(rng, 7, 3, 2)))
    answer = solver.solve()
    assert answer.status is Status.SOLVED
    assert answer.x is not None
