import importlib.metadata
import subprocess
import sys

import numpy as np
import pytest
import qpsolvers
from hypothesis import given, settings
from hypothesis import strategies as st
from qpsolvers.solvers import solve_function

from rrnn_opt.errors import RrnnError
from rrnn_opt.solving import register_qpsolvers, unregister_qpsolvers

EXACT = {"primal_tol": 1e-10, "dual_tol": 1e-12}


@pytest.fixture(scope="module", autouse=True)
def _registered():
    register_qpsolvers()
    yield
    unregister_qpsolvers()


def random_qp(seed, *, n=6, meq=2, mineq=4, box=True, condition=100.0):
    """Strictly convex, feasible at some point, most rows close to it."""
    rng = np.random.default_rng(seed)
    basis = np.linalg.qr(rng.normal(size=(n, n)))[0]
    P = basis @ np.diag(np.geomspace(1.0, condition, n)) @ basis.T
    x, A, G = rng.uniform(-0.5, 0.5, n), rng.normal(size=(meq, n)), None
    rows = {"A": A, "b": A @ x} if meq else {}
    if mineq:
        G = rng.normal(size=(mineq, n))
        rows |= {"G": G, "h": G @ x + rng.uniform(0.0, 0.3, mineq)}
    if box:
        rows |= {"lb": -np.ones(n), "ub": np.ones(n)}
    return qpsolvers.Problem((P + P.T) / 2, 3.0 * rng.normal(size=n), **rows)


def assert_same(problem, *, atol=1e-6, **settings):
    ours = qpsolvers.solve_problem(problem, solver="rrnn", **settings)
    theirs = qpsolvers.solve_problem(problem, solver="daqp", **EXACT)
    assert ours.found
    assert ours.is_optimal(1e-6)
    np.testing.assert_allclose(ours.x, theirs.x, atol=atol)
    for part in ("y", "z", "z_box"):
        want = getattr(theirs, part)
        if want is not None and want.size:
            np.testing.assert_allclose(getattr(ours, part), want, atol=20 * atol)
    return ours


def test_it_stands_in_the_tables_of_dense_solvers_only():
    assert "rrnn" in qpsolvers.available_solvers
    assert "rrnn" in qpsolvers.dense_solvers
    assert "rrnn" not in qpsolvers.sparse_solvers


def test_a_second_call_changes_nothing_and_unregistering_takes_all_back():
    before = list(qpsolvers.available_solvers)
    register_qpsolvers()
    assert qpsolvers.available_solvers == before
    unregister_qpsolvers()
    unregister_qpsolvers()
    try:
        assert "rrnn" not in qpsolvers.available_solvers + qpsolvers.dense_solvers
        with pytest.raises(qpsolvers.SolverNotFound):
            qpsolvers.solve_problem(random_qp(0), solver="rrnn")
    finally:
        register_qpsolvers()


def test_the_name_of_another_solver_is_not_taken():
    daqp = solve_function["daqp"]
    with pytest.raises(RrnnError, match="another name"):
        register_qpsolvers("daqp")
    unregister_qpsolvers("daqp")
    assert solve_function["daqp"] is daqp
    assert "daqp" in qpsolvers.available_solvers


def test_importing_the_package_registers_nothing():
    code = (
        "import qpsolvers, rrnn_opt as rr, rrnn_opt.solving.register\n"
        "assert 'rrnn' not in qpsolvers.available_solvers\n"
        "rr.solving.register_qpsolvers()\n"
        "assert 'rrnn' in qpsolvers.available_solvers\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


@given(seed=st.integers(0, 10_000))
@settings(max_examples=20)
def test_random_programmes_have_the_optimum_and_multipliers_of_daqp(seed):
    assert_same(random_qp(seed))


@pytest.mark.parametrize(
    "parts",
    [
        {"meq": 0, "mineq": 0, "box": False},
        {"meq": 0, "mineq": 0},
        {"meq": 3, "mineq": 0, "box": False},
        {"meq": 0, "mineq": 5, "box": False},
        {"n": 8, "meq": 3, "mineq": 6, "condition": 1e5},
    ],
    ids=["free", "box", "rows", "inequalities", "large"],
)
def test_any_part_may_be_absent(parts):
    assert_same(random_qp(3, **parts))


def test_solve_qp_gives_the_point():
    problem = random_qp(5)
    x = qpsolvers.solve_qp(*problem.unpack(), solver="rrnn")
    np.testing.assert_allclose(x, assert_same(problem).x)


def test_what_is_done_is_told():
    extras = assert_same(random_qp(7), tolerance=1e-9).extras
    assert extras["status"] == "solved"
    assert extras["kkt_residual"] <= 1e-9
    assert extras["steps"] > 0


def test_a_start_at_the_optimum_saves_steps():
    problem = random_qp(1, meq=0, mineq=0, box=False)
    cold = qpsolvers.solve_problem(problem, solver="rrnn")
    warm = qpsolvers.solve_problem(problem, solver="rrnn", initvals=cold.x)
    assert warm.extras["steps"] < cold.extras["steps"]
    with pytest.raises(qpsolvers.ProblemError, match="initvals"):
        qpsolvers.solve_problem(problem, solver="rrnn", initvals=np.zeros(2))


def test_one_sided_bounds():
    problem = random_qp(11)
    problem.ub[:3] = np.inf
    problem.lb[2:] = -np.inf
    solution = assert_same(problem)
    assert (solution.z_box[:3] <= 0.0).all()
    assert solution.z_box[2] == 0.0


def test_dependent_rows_are_no_obstacle():
    problem = random_qp(2)
    problem.A = np.vstack([problem.A, problem.A.sum(axis=0)])
    problem.b = np.append(problem.b, problem.b.sum())
    x = qpsolvers.solve_problem(problem, solver="rrnn")
    assert x.is_optimal(1e-6)
    np.testing.assert_allclose(x.x, assert_same(random_qp(2)).x, atol=1e-6)


@pytest.mark.parametrize("rank", [0, 3])
def test_a_singular_hessian_is_solved_by_proximal_steps(rank):
    problem = random_qp(4, meq=1, mineq=0)
    rows = np.random.default_rng(0).normal(size=(rank, 6))
    problem.P = rows.T @ rows
    ours = qpsolvers.solve_problem(problem, solver="rrnn")
    theirs = qpsolvers.solve_problem(problem, solver="proxqp", eps_abs=1e-9)
    assert ours.found
    assert ours.is_optimal(1e-6)
    best = theirs.x @ (0.5 * problem.P @ theirs.x + problem.q)
    assert ours.obj == pytest.approx(best, abs=1e-5)


@pytest.mark.parametrize("seed", range(3))
def test_an_infeasible_programme_is_not_found(seed):
    problem = random_qp(seed)
    problem.b = problem.b + 100.0
    solution = qpsolvers.solve_problem(problem, solver="rrnn", max_steps=5000)
    assert not solution.found
    assert solution.x is None
    assert solution.extras["status"] == "primal_infeasible"


def test_an_unbounded_programme_is_not_found():
    problem = qpsolvers.Problem(np.zeros((2, 2)), np.ones(2))
    solution = qpsolvers.solve_problem(problem, solver="rrnn", max_steps=1000)
    assert not solution.found
    assert solution.extras["status"] == "max_iter"


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"P": np.diag([1.0, 1.0, 1.0, 1.0, 1.0, -0.1])}, "semidefinite"),
        ({"q": np.full(6, np.nan)}, "finite"),
        ({"lb": np.full(6, np.nan)}, "finite"),
    ],
)
def test_what_is_no_convex_programme_is_refused(change, message):
    problem = random_qp(0)
    for part, value in change.items():
        setattr(problem, part, value)
    with pytest.raises(qpsolvers.ProblemError, match=message):
        qpsolvers.solve_problem(problem, solver="rrnn")


def test_what_is_too_large_is_refused():
    with pytest.raises(qpsolvers.ProblemError, match="too large"):
        qpsolvers.solve_problem(random_qp(0, n=150), solver="rrnn")


def panda():
    """Pinocchio model of a Panda with fingers, and a posture."""
    import pinocchio as pin

    files = importlib.metadata.files("example-robot-data")
    (path,) = (f.locate() for f in files if f.name == "panda.urdf")
    model = pin.buildModelFromUrdf(str(path))
    return model, np.array([0.0, -0.7, 0.0, -2.0, 0.0, 1.5, 0.7, 0.02, 0.02])


@pytest.mark.parametrize("posture_cost", [1e-2, 1e-3, None])
def test_pink_moves_a_panda_with_it(posture_cost):
    """The same velocities as with DAQP, at speed limits first, then free."""
    pink = pytest.importorskip("pink")
    model, q = panda()
    configuration = pink.Configuration(model, model.createData(), q)
    hand = pink.FrameTask("panda_hand", position_cost=1.0, orientation_cost=0.5)
    target = configuration.get_transform_frame_to_world("panda_hand").copy()
    target.translation = target.translation + np.array([0.1, 0.1, -0.1])
    hand.set_target(target)
    tasks = [hand]
    if posture_cost is not None:
        tasks.append(pink.PostureTask(cost=posture_cost))
        tasks[1].set_target(q)
    at_limit = []
    for _ in range(16):
        problem = pink.build_ik(configuration, tasks, 0.03)
        at_limit.append(qpsolvers.solve_problem(problem, "rrnn").z.max() > 1e-6)
        ours = pink.solve_ik(configuration, tasks, 0.03, "rrnn")
        theirs = pink.solve_ik(configuration, tasks, 0.03, "daqp", **EXACT)
        np.testing.assert_allclose(ours, theirs, atol=1e-3)
        configuration.integrate_inplace(ours, 0.03)
    assert any(at_limit)
    assert not all(at_limit)
    reached = np.linalg.norm(hand.compute_error(configuration)[:3])
    assert reached < 5e-3
