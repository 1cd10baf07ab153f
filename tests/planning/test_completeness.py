"""The assumptions of the proof in docs/completeness.md, one test each."""

import dataclasses

import numpy as np
import pytest
from scipy import stats

import rrnn_opt as rr
from rrnn_opt.networks import MemoryCell
from rrnn_opt.planning import PaperRnn, Problem, RandomRnn, plan
from rrnn_opt.planning.rollout.library import RolloutSearch, rollout_runtime_of
from rrnn_opt.planning.search.library import Runtime
from rrnn_opt.planning.search.request import pack

RANDOM = RandomRnn(coin=1.0, connect=False)
APART = {
    "robot": "planar3",
    "start": [np.pi / 2, 0.3, 0.3],
    "goal": {"joints": [-np.pi / 2, -0.3, -0.3]},
    "obstacles": [
        {
            "name": f"fin{x}",
            "type": "box",
            "position": [x, 0.0, 0.0],
            "size": [2.4, 0.02, 0.2],
        }
        for x in (-1.4, 1.4)
    ],
}
FREE = {**APART, "obstacles": []}


def explored(open_search, runtime, data, settings, budget, seed=0):
    with open_search(runtime, Problem.from_dict(data), seed, settings) as search:
        search.run(budget, 60.0)
        return search.trees(), search.activity(), search.counts()


def edge_distribution(share):
    """P(coordinate <= share of its range) when u^6 / 2 is its way from a limit."""
    near = np.minimum(share, 1.0 - share)
    part = 0.5 * (2.0 * near) ** (1.0 / 6.0)
    return np.where(share < 0.5, part, 1.0 - part)


def test_random_targets_have_their_distribution(open_search):
    """Where nothing can collide a slide ends at its target: leaves are the draws."""
    robot = rr.Robot.builtin("raven2")
    assert not robot.sphere_pairs()
    runtime, limits, draws = Runtime(robot, MemoryCell()), robot.limits, []
    start = np.clip(np.full(robot.nv, 0.1), limits.lower, limits.upper)
    goal = np.clip(start + 0.2, limits.lower, limits.upper)
    data = {"robot": "raven2", "start": start.tolist()}
    data |= {"goal": {"joints": goal.tolist()}, "obstacles": []}
    for seed in range(150):
        settings = dataclasses.replace(RANDOM, node_gap=1e9)
        trees, _, _ = explored(open_search, runtime, data, settings, 1, seed)
        grown = max(trees, key=lambda tree: len(tree[0]))[0]
        draws.append(grown[-1])
    bounded = np.isfinite(limits.lower)
    share = (np.array(draws) - limits.lower) / (limits.upper - limits.lower)
    for column in share.T[bounded]:
        assert stats.kstest(column, edge_distribution).pvalue > 1e-3
    assert abs(np.corrcoef(share[:, 0], share[:, 1])[0, 1]) < 0.25


def test_the_cell_stays_between_its_two_levels():
    step, x = MemoryCell().function(), 0.0
    rng = np.random.default_rng(0)
    levels = []
    x = float(step(x, 1.0))
    for stimulus in rng.integers(0, 2, 3000):
        x = float(step(x, float(stimulus)))
        levels.append(x)
    for _ in range(500):
        x = float(step(x, 0.0))
    assert x == pytest.approx(1 - 0.9 / 0.95, abs=1e-6)
    assert min(levels) > 1 - 0.9 / 0.95
    assert max(levels) < 0.6414


def test_the_first_failure_wakes_the_cell(planar_runtime, open_search):
    """Goals that cannot be reached: the first exploration is heuristic and fails."""
    _, activity, counts = explored(open_search, planar_runtime, APART, RandomRnn(), 300)
    assert activity[0] == 0.0
    assert np.all(activity[1:] > 1 - 0.9 / 0.95)
    assert counts.random > 20


def test_a_slide_with_room_ends_at_its_target(planar_runtime, open_search, rng):
    """Free straight ways, with 2 cm to spare, are followed to the end."""
    problem, followed = Problem.from_dict(APART), 0
    limits = planar_runtime.robot.limits
    for _ in range(60):
        a = rng.uniform(limits.lower, limits.upper)
        b = np.clip(a + rng.uniform(-0.5, 0.5, 3), limits.lower, limits.upper)
        with open_search(planar_runtime, problem) as search:
            if not search.segment_free(a, b, 0.02):
                continue
        data = {**APART, "start": a.tolist(), "goal": {"joints": b.tolist()}}
        with open_search(planar_runtime, Problem.from_dict(data)) as search:
            assert search.run(1, 60.0) == "solved"
            followed += 1
    assert followed >= 10


def test_a_random_slide_starts_at_the_joint_nearest_node(planar_runtime, open_search):
    """In free space a leaf is its own draw, so its parent is the nearest node."""
    settings = dataclasses.replace(RANDOM, node_gap=1e9, edge=1)
    limits = planar_runtime.robot.limits
    for seed in range(5):
        trees, _, _ = explored(open_search, planar_runtime, FREE, settings, 20, seed)
        for nodes, parents in trees:
            for i in range(1, len(nodes)):
                inside = np.abs(nodes[i][2]) < 2.0 < limits.upper[2]
                if parents[i] >= 0 and inside:
                    ways = np.linalg.norm(nodes[:i] - nodes[i], axis=1)
                    assert ways[parents[i]] == pytest.approx(ways.min(), abs=1e-9)


def test_a_stretched_arm_never_leaves_its_line():
    """Counterexample: J'e = 0 for a point on the line through base and tip."""
    data = {**FREE, "start": [0.0] * 3, "goal": {"position": [1.2, 0.0, 0.0]}}
    problem, settings = Problem.from_dict(data), PaperRnn(feed="failure")
    runtime = rollout_runtime_of(problem.robot, settings)
    packed = pack(problem, (), problem.goals, 0)
    with RolloutSearch(runtime, settings, packed.struct, packed.keep) as search:
        for x in (0.1, 0.7, 1.2, 2.0):
            u, error = search.velocity(np.zeros(3), np.zeros(3), [x, 0.0, 0.0])
            np.testing.assert_array_equal(u, 0.0)
            assert error == pytest.approx(2.4 - x)
    result = plan(problem, planner="paper", max_explorations=200)
    assert result.status == "budget_exhausted"
    assert (result.stats.heuristic, set(result.stats.memory_cell)) == (200, {0.0})
    assert plan(problem).solved
