"""What other processes are sent arrives as it was: problems, plans, errors."""

import pickle
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import pytest

from rrnn_opt import errors
from rrnn_opt.planning import Problem, plan
from tests.faults.conftest import PROBLEM

ERRORS = [
    errors.ShapeError("q", (7,), (6,)),
    errors.ArgumentError("q", "is odd"),
    errors.NotFiniteError("q"),
    errors.NotAQpError("objective", "sin", "make it linear", expression="sin(x)"),
    errors.UnsupportedOperationError("sin", "the prover"),
    errors.RobotError("arm.urdf", "has no joint"),
    errors.ProblemError("goal", "is missing"),
    errors.CompilerError("failed", ["cc", "-c"], "a line"),
    errors.InfeasibleQpError("no point", 0.5),
    errors.RetimeError("too fast", "limits"),
    errors.DocumentError("plan.json", "is torn"),
    errors.UndecidedError("out of time"),
    errors.LayoutError("q", (2, 2), "transpose it"),
]


@pytest.mark.parametrize("error", ERRORS, ids=lambda error: type(error).__name__)
@pytest.mark.parametrize("protocol", range(2, pickle.HIGHEST_PROTOCOL + 1))
def test_an_error_keeps_its_sentence_and_its_data(error, protocol):
    again = pickle.loads(pickle.dumps(error, protocol))
    assert type(again) is type(error)
    assert str(again) == str(error)
    assert vars(again) == vars(error)


def test_no_error_is_forgotten_above():
    kinds = {kind for kind in vars(errors).values() if isinstance(kind, type)}
    ours = {kind for kind in kinds if issubclass(kind, errors.RrnnError)}
    assert {type(error) for error in ERRORS} == ours - {errors.RrnnError}


@pytest.mark.slow
def test_a_pool_of_new_processes_plans_and_fails_as_this_one_does():
    problem = Problem.from_dict(PROBLEM)
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        refused = pool.submit(Problem.from_dict, PROBLEM | {"goal": {}})
        with pytest.raises(errors.ProblemError) as there:  # and the pool lives on
            refused.result()
        planned = pool.submit(plan, problem).result()
    with pytest.raises(errors.ProblemError) as here:
        Problem.from_dict(PROBLEM | {"goal": {}})
    assert str(there.value) == str(here.value)
    mine = plan(problem).to_dict()
    for key in ("status", "path", "trajectory"):
        assert planned.to_dict()[key] == mine[key]


def test_a_problem_and_its_plan_are_the_same_after_a_journey():
    problem = Problem.from_dict(PROBLEM)
    for thing in (problem, problem.robot, problem.scene, plan(problem)):
        assert pickle.loads(pickle.dumps(thing)).to_dict() == thing.to_dict()
