"""The sets are what they say: feasible by construction, infeasible by a certificate."""

import numpy as np
import pytest

from rrnn_opt.errors import RrnnError
from rrnn_opt.solving import DaqpSession, find_farkas
from rrnn_opt.solving.parts import Dense
from rrnn_opt.study.comparison import GROUPS, named_set, own_sets, set_names
from rrnn_opt.study.comparison.catalogue import installed, problem_set
from rrnn_opt.study.comparison.drawn import DRAWS, drawn_set
from rrnn_opt.study.comparison.interchange import write_test_set
from rrnn_opt.study.comparison.motions import motion_set


def optimum(instance):
    solver = DaqpSession(mode="cold")
    solver.setup(instance)
    return solver.solve().x


@pytest.mark.parametrize("name", [n for n in DRAWS if n != "dense"])
def test_drawn_sets_hold_what_they_say(name):
    problems = drawn_set(name)
    for instance, truth in list(zip(problems.instances, problems.truth, strict=True))[
        :8
    ]:
        proved = find_farkas(instance.problem) is not None
        assert proved == (truth == "infeasible")


def test_a_drawn_problem_depends_on_name_seed_and_number_alone():
    first, again = drawn_set("convex"), drawn_set("convex")
    other = drawn_set("convex", seed=1)
    np.testing.assert_array_equal(
        first.instances[5].problem.P, again.instances[5].problem.P
    )
    assert first.instances[5].problem.q[0] != other.instances[5].problem.q[0]


def test_degenerate_problems_have_more_active_rows_than_unknowns():
    problem = Dense.of(drawn_set("degenerate").instances[0].problem)
    assert np.linalg.matrix_rank(problem.P) < len(problem.q)
    x = optimum(drawn_set("degenerate").instances[0])
    active = (problem.h - problem.G @ x < 1e-7).sum()
    at_bound = ((x - problem.lb < 1e-7) | (problem.ub - x < 1e-7)).sum()
    assert active + at_bound + len(problem.b) > len(problem.q)


def test_scaled_problems_span_many_powers_of_ten():
    problem = Dense.of(drawn_set("scaled").instances[0].problem)
    sizes = np.abs(np.diag(problem.P))
    assert sizes.max() / sizes.min() > 1e6


@pytest.mark.parametrize("name", ["pa10", "raven2"])
def test_motions_have_active_obstacles_and_infeasible_stretches(name):
    near = motion_set("obstacles", name)
    active = 0
    for instance in near.instances:
        problem, x = Dense.of(instance.problem), optimum(instance)
        active += bool((problem.h - problem.G @ x < 1e-7).any())
    assert active >= len(near) / 2
    beyond = motion_set("infeasible", name)
    assert beyond.truth.count("infeasible") >= 20
    assert beyond.truth.count("solvable") >= 30
    for instance, truth in zip(beyond.instances, beyond.truth, strict=True):
        if truth == "infeasible":
            assert find_farkas(instance.problem) is not None


def test_the_singular_motion_starts_where_the_jacobian_nearly_loses_rank():
    problem = Dense.of(motion_set("singular", "panda").instances[0].problem)
    assert np.linalg.svd(problem.A, compute_uv=False)[-1] < 0.03


def test_an_arm_of_a_urdf_moves_too():
    there, reasons = installed(["circle/ur5"])
    if not there:
        pytest.skip(reasons[0])
    assert len(problem_set("circle/ur5")) == 60


def test_names():
    assert set_names("circle") == GROUPS["circle"]
    assert set_names("circle/pa10") == ("circle/pa10",)
    with pytest.raises(RrnnError, match="no study 'circles'"):
        set_names("circles")


def test_a_test_set_of_qpbenchmark_goes_out_and_comes_back(tmp_path):
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    problems = drawn_set("convex")
    path = write_test_set(problems, tmp_path / "mine.parquet")
    (back,) = own_sets(str(path)).values()
    assert back.name == "mine"
    for ours, theirs in zip(problems.instances, back.instances, strict=True):
        for key in ("P", "q", "G", "h", "A", "b", "lb", "ub"):
            given = getattr(ours.problem, key)
            np.testing.assert_array_equal(getattr(theirs.problem, key), given)


def test_a_file_of_the_user(tmp_path):
    path = tmp_path / "mine.py"
    path.write_text(
        "import numpy as np\n"
        "from qpsolvers import Problem\n"
        "def cases():\n"
        "    eye, one = np.eye(2), np.ones(2)\n"
        "    good = Problem(eye, one, lb=-one, ub=one)\n"
        "    bad = Problem(eye, one, lb=one, ub=-one)\n"
        "    yield 'mine', [good, bad]\n"
    )
    (found,) = own_sets(str(path)).values()
    assert found.truth == ("solvable", "infeasible")
    assert found.sequence
    path.write_text("x = 1\n")
    with pytest.raises(RrnnError, match=r"no function cases\(\)"):
        own_sets(str(path))
    with pytest.raises(RrnnError, match=r"qpsolvers\.Problem"):
        named_set("x", [1])
