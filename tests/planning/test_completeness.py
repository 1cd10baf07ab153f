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
    runtime, limits, count = Runtime(robot, MemoryCell()), robot.limits, 3000
    start = np.clip(np.full(robot.nv, 0.1), limits.lower, limits.upper)
    goal = np.clip(start + 0.2, limits.lower, limits.upper)
    data = {"robot": "raven2", "start": start.tolist()}
    data |= {"goal": {"joints": goal.tolist()}, "obstacles": []}
    settings = dataclasses.replace(RANDOM, node_gap=1e9)
    trees, _, _ = explored(open_search, runtime, data, settings, count)
    bounded = np.isfinite(limits.lower)
    width = (limits.upper - limits.lower)[bounded]
    grown = [(nodes[1:, bounded] - limits.lower[bounded]) / width for nodes, _ in trees]
    share = np.concatenate(grown)
    assert len(share) == count
    cuts = np.array([0.0, 0.1, 0.25, 0.4, 0.45, 0.5, 0.55, 0.6, 0.75, 0.9, 1.0])
    expected = count * np.diff(edge_distribution(cuts))
    for column in share.T:
        assert stats.kstest(column, edge_distribution).pvalue > 1e-3
        seen = np.histogram(column, cuts)[0]  # also the middle, where draws are rare
        assert stats.chisquare(seen, expected).pvalue > 1e-4
    across = np.corrcoef(share.T) - np.eye(len(width))
    assert np.abs(across).max() < 0.1
    for draws in grown:  # independent of the past, which is another tree's too
        after = [np.corrcoef(draws[1:, k], draws[:-1, k])[0, 1] for k in range(3)]
        assert np.abs(after).max() < 0.12


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


@pytest.mark.parametrize("coin", [-1.0, 0.1, 0.6])
def test_random_explorations_are_as_frequent_as_the_cell_says(
    coin, planar_runtime, open_search
):
    """Every choice is one exploration without connecting slides, and their number
    has the mean sum(x): trees that cannot meet always have pairs left to try."""
    settings = RandomRnn(coin=None if coin < 0 else coin, connect=False)
    seen = explored(open_search, planar_runtime, APART, settings, 1500)
    _, activity, counts = seen
    assert counts.random + counts.heuristic == len(activity) == 1500
    mean, variance = activity.sum(), (activity * (1 - activity)).sum()
    assert abs(counts.random - mean) < 4 * np.sqrt(variance)
    assert mean > 0.05 * 1500


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
