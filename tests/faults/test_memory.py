"""Many plans in one process: what it holds does not grow with them."""

import gc
import resource
from pathlib import Path

import pytest

from rrnn_opt.planning import Problem, plan
from tests.faults.conftest import PROBLEM

PLANS, WARM = 1200, 200


def resident():
    """Bytes that this process holds."""
    pages = int(Path("/proc/self/statm").read_text("utf-8").split()[1])
    return pages * resource.getpagesize()


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="needs /proc")
def test_a_thousand_more_plans_need_no_more_memory():
    """A kilobyte lost a plan would be 1 MB; the allocators have some slack."""
    goals = [[1.0, 0.2, -0.4], [-1.0, 0.5, 0.4], [0.3, -0.8, 1.1]]
    near = {"name": "near", "type": "box", "size": [0.3, 0.3, 0.3]}
    near |= {"position": [1.2, -1.2, 0.0]}
    problems = [
        Problem.from_dict(PROBLEM | {"goal": {"joints": goal}, "obstacles": [near]})
        for goal in goals
    ]
    before = 0
    for n in range(PLANS):
        plan(problems[n % len(problems)], seed=n).to_dict()
        if n == WARM:
            gc.collect()
            before = resident()
    gc.collect()
    assert resident() - before < 3e6
