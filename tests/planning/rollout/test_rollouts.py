"""The rolled-out schemes against the declared ones, and what plans of them are."""

import dataclasses
import functools
import itertools

import casadi as ca
import numpy as np
import pytest
import qpsolvers

import rrnn_opt as rr
from rrnn_opt import check
from rrnn_opt.errors import ProblemError
from rrnn_opt.formulations import joint_sign_sets, method1, method2
from rrnn_opt.formulations.signs import Band
from rrnn_opt.networks import PrimalDual
from rrnn_opt.planning import PaperRnn, Problem, RandomRnn, SingleRollout, plan
from rrnn_opt.planning.rollout.library import (
    RolloutSearch,
    rollout_runtime_of,
    thinned,
)
from rrnn_opt.planning.search.request import pack
from rrnn_opt.robot.bound import reach_ball

SAFE = 0.2
BALL = {"name": "ball", "type": "sphere", "radius": 0.2, "position": [1.3, 0.9, 0.0]}
SECOND = PaperRnn(safe=SAFE)
LEVELS = {"velocity": method1, "acceleration": method2}


@pytest.fixture(scope="module")
def planar():
    return rr.Robot.builtin("planar3")


def document(**more):
    return {
        "robot": "planar3",
        "start": [-0.3, 0.4, 0.5],
        "goal": {"position": [0.6, 1.6, 0.0], "tolerance": 0.001},
        "obstacles": [BALL],
        **more,
    }


def walled():
    """The arm upright, the goal behind a wall that nothing passes."""
    wall = {"name": "wall", "type": "box", "size": [0.1, 6.0, 1.0]}
    return document(
        start=[np.pi / 2, 0.0, 0.0],
        goal={"position": [2.0, 0.5, 0.0]},
        obstacles=[{**wall, "position": [1.2, 0.0, 0.0]}],
    )


def opened(problem, settings, seed=0):
    runtime = rollout_runtime_of(problem.robot, settings)
    packed = pack(problem, (), problem.goals, seed)
    return RolloutSearch(runtime, settings, packed.struct, packed.keep)


def states(rng, robot, count):
    """Free postures with velocities inside half of the speed limits."""
    problem = Problem.from_dict(document())
    with opened(problem, SECOND) as search:
        while count > 0:
            q = rng.uniform(0.8 * robot.limits.lower, 0.8 * robot.limits.upper)
            if search.postures_free(q)[0]:
                count -= 1
                yield q, rng.uniform(-0.5, 0.5, robot.nv) * robot.limits.velocity


def near_states(rng, robot, count):
    """States of ``states`` with a contact."""
    every = states(rng, robot, 10**6)
    return itertools.islice((s for s in every if contacts(robot, s[0])[0]), count)


def contacts(robot, q):
    """Sphere, gap and outward normal of every sphere within SAFE of the ball."""
    centre = np.array(BALL["position"])
    away = at("centres", q) - centre[:, None]
    length = np.linalg.norm(away, axis=0)
    radii = np.array([s.radius for s in robot.spheres])
    gaps = length - BALL["radius"] - radii
    near = np.flatnonzero(gaps <= SAFE)
    return near.tolist(), gaps[near], away[:, near] / length[near]


@pytest.mark.parametrize("reading", ["transpose", "index"])
def test_a_step_is_eulers_of_the_declared_network(planar, rng, reading):
    """PrimalDual of joint_sign_sets is (17) with (10) and (12)."""
    target = np.array([0.6, 1.6, 0.0])
    settings = dataclasses.replace(SECOND, reading=reading)
    with opened(Problem.from_dict(document()), settings) as search:
        for q, u in near_states(rng, planar, 6):
            spheres, gaps, normals = contacts(planar, q)
            form = joint_sign_sets(
                forward()[0], contacts=spheres, reading=reading, safe=SAFE
            )
            dynamics = PrimalDual(settings.epsilon)(form)
            given = {"q": q, "rd": target, "normals": normals, "clearances": gaps}
            values = [given[p.name] for p in dynamics.parameters]
            rate = ca.Function(
                "rate",
                [dynamics.state.sx, *(p.sx for p in dynamics.parameters)],
                [dynamics.derivative],
            )
            wanted = u + settings.step * np.array(rate(u, *values)).ravel()
            after, error = search.velocity(q, u, target)
            np.testing.assert_allclose(after, wanted, atol=1e-10)
            assert error == pytest.approx(np.linalg.norm(target - tip(planar, q)))


@functools.cache
def forward():
    """Tip, its Jacobian and the spheres' centres of the planar arm."""
    kin = rr.Kinematics(rr.Robot.builtin("planar3"))
    centres = kin.sphere_centres()
    return kin, {
        "tip": ca.Function("tip", [kin.q], [kin.position()]),
        "jacobian": ca.Function("jacobian", [kin.q], [kin.jacobian()]),
        "centres": ca.Function("centres", [kin.q], [centres]),
        "slopes": ca.Function("slopes", [kin.q], [ca.jacobian(ca.vec(centres), kin.q)]),
    }


def at(name, q):
    return np.array(forward()[1][name](q))


def tip(robot, q):
    return at("tip", q).ravel()


def test_first_order_is_the_fixed_point_of_the_second(planar, rng):
    target = np.array([0.6, 1.6, 0.0])
    first = dataclasses.replace(SECOND, order="first")
    problem = Problem.from_dict(document())
    with opened(problem, first) as fast, opened(problem, SECOND) as slow:
        for q, u in states(rng, planar, 10):
            wanted, _ = fast.velocity(q, u, target)
            for _ in range(400):
                u, _ = slow.velocity(q, u, target)
            np.testing.assert_allclose(u, wanted, atol=1e-9)


@pytest.mark.parametrize("level", list(LEVELS))
def test_a_scheme_step_solves_the_declared_programme(planar, rng, level):
    """Swept to convergence; magnitudes are those stored in the same step."""
    settings = SingleRollout(
        level=level, sweeps=300_000, inner=0.05, outer=SAFE, contacts=16, rate=2.0
    )
    target, solved = np.array([0.6, 1.6, 0.0]), 0
    with opened(Problem.from_dict(document()), settings) as search:
        for q, u in near_states(rng, planar, 8):
            u = 0.1 * u
            answer = _declared(planar, settings, q, u, target)
            if answer is None:
                continue
            after, _ = search.velocity(q, u, target)
            if level == "acceleration":
                after = (after - u) / settings.step
            solved += 1
            np.testing.assert_allclose(after, answer, atol=2e-4)
    assert solved >= 2


def _declared(planar, settings, q, u, target):
    """Optimum of ``method1`` or ``method2``, or None where there is none."""
    spheres, gaps, normals = contacts(planar, q)
    kin, level = forward()[0], settings.level
    band = Band(settings.inner, settings.outer)
    form = LEVELS[level](kin, contacts=spheres, band=band)
    # a planar arm has no z: its row is left out
    error = target - tip(planar, q)
    length = np.linalg.norm(error)
    v = error * min(settings.gain, settings.speed / length)
    J = at("jacobian", q)
    given = {"q": q, "qd": u, "rd_dot": v, "normals": normals, "clearances": gaps}
    given["rd_ddot"] = settings.rate * (v - J @ u)
    rows = at("slopes", q).reshape(-1, 3, planar.nv)
    stored = [
        np.maximum(-np.sign(n) * (rows[i] @ u), 0)
        for i, n in zip(spheres, normals.T, strict=True)
    ]
    given["magnitudes"] = np.concatenate(stored or [np.zeros(0)])
    names = [p.name for p in form.parameters]
    try:
        qp = form.qp.at(**{name: given[name] for name in names})
    except rr.errors.RrnnError:
        return None
    A, b = qp.A[:2], qp.b[:2]
    small = qpsolvers.Problem(qp.P, qp.q, qp.G, qp.h, A, b, qp.lb, qp.ub)
    answer = qpsolvers.solve_problem(small, solver="daqp")
    return answer.x if answer.found else None


def test_sign_set_of_the_printed_indices_leads_into_the_obstacle(planar):
    """The stated counterexample: a planar arm along y with its obstacle at -x.

    n = (1, 0, 0) leaves the first joint [0, d+]; turning it forwards moves the
    tip along -x, into the obstacle.
    """
    settings = PaperRnn(order="first", reading="index", safe=0.3)
    wall = {"name": "wall", "type": "box", "size": [0.1, 6.0, 1.0]}
    data = document(
        start=[np.pi / 2, 0.0, 0.0],
        obstacles=[{**wall, "position": [-0.3, 0.0, 0.0]}],
    )
    target = np.array([-1.0, 2.0, 0.0])
    q = np.array(data["start"])
    with opened(Problem.from_dict(data), settings) as search:
        u, _ = search.velocity(q, np.zeros(3), target)
    J = at("jacobian", q)
    assert u[0] > 0.1
    assert (J @ u)[0] < -0.1
    transpose = dataclasses.replace(settings, reading="transpose")
    with opened(Problem.from_dict(data), transpose) as search:
        u, _ = search.velocity(q, np.zeros(3), target)
    assert np.max(u) <= 0.0


def test_contact_only_never_wakes_the_cell_when_sets_stop_the_arm():
    """With (12) kept exactly no step collides, so I = 0 and x = 0 for ever."""
    problem = Problem.from_dict(walled())
    first = PaperRnn(order="first", safe=0.05)
    result = plan(problem, settings=first, planner="paper", max_explorations=40)
    assert result.status == "budget_exhausted"
    assert set(result.stats.memory_cell) == {0.0}
    assert result.stats.random == 0
    fed = dataclasses.replace(first, feed="failure")
    result = plan(problem, settings=fed, planner="paper", max_explorations=40)
    assert result.stats.random > 5
    assert max(result.stats.memory_cell) == pytest.approx(0.6413, abs=1e-3)


def test_paper_solves_what_needs_no_luck_and_its_path_is_proved():
    problem = Problem.from_dict(document(obstacles=[]))
    result = plan(problem, planner="paper", seed=2)
    assert (result.status, result.stats.heuristic) == ("solved", 1)
    again = check.certify_trajectory(result.robot, result.problem, result.trajectory)
    assert (again.collision_free, again.limits) == ("PROVED", "PROVED")


@pytest.mark.parametrize("planner", ["method1", "method2"])
def test_single_rollouts_say_that_they_are_single(planner):
    """Around the ball and in front of it; z is no task of a planar arm."""
    solved = plan(Problem.from_dict(document(obstacles=[])), planner=planner)
    assert solved.status == "solved"
    result = plan(Problem.from_dict(walled()), planner=planner, max_explorations=50)
    assert result.status == "budget_exhausted"
    assert "single rollout" in result.message
    assert result.stats.heuristic == 1


def test_only_positions_are_goals_of_the_printed_schemes():
    problem = Problem.from_dict(document(goal={"joints": [0.5] * 3}, obstacles=[]))
    with pytest.raises(ProblemError, match="'paper' goes to positions"):
        plan(problem, planner="paper")


def test_the_same_seed_rolls_the_same_tree():
    problem = Problem.from_dict(document())
    settings = PaperRnn(coin=0.5)
    trees = []
    for seed in (5, 5, 6):
        with opened(problem, settings, seed) as search:
            status = "paused"
            while status == "paused":
                status = search.run(12, 1e-9 if len(trees) == 1 else 10.0)
            trees.append(search.nodes()[0])
    np.testing.assert_array_equal(trees[0], trees[1])
    assert trees[0].shape != trees[2].shape or np.any(trees[0] != trees[2])


def test_the_way_to_a_node_is_rolled_again_to_the_last_bit():
    problem = Problem.from_dict(document())
    with opened(problem, PaperRnn(coin=0.5), 3) as search:
        search.run(10, 10.0)
        postures, parents = search.nodes()
        assert len(postures) > 3
        for node in range(len(postures)):
            way = search.way(node)
            np.testing.assert_array_equal(way[0], problem.start)
            np.testing.assert_array_equal(way[-1], postures[node])
            assert parents[node] < node
            short = thinned(search, way)
            pairs = itertools.pairwise(short)
            assert all(search.segment_free(a, b) for a, b in pairs)
        with pytest.raises(IndexError, match="T_s has nodes"):
            search.way(len(postures))


def test_random_points_lie_in_the_ball_of_reach(planar):
    """Every tip that a rollout reached is within reach; so are its targets."""
    centre, radius = reach_ball(planar)
    problem = Problem.from_dict(document(obstacles=[]))
    with opened(problem, PaperRnn(coin=1.0), 1) as search:
        search.run(30, 10.0)
        postures, _ = search.nodes()
        tips = np.array([tip(planar, q) for q in postures])
    assert np.all(np.linalg.norm(tips - centre, axis=1) <= radius + 1e-9)
    assert len(np.unique(tips[:, 0].round(6))) > 10


def test_a_search_without_switches_differs_from_one_with(planar_runtime, open_search):
    """The switches reach the runtime: each changes what the search does."""
    problem = Problem.from_dict(document(goal={"joints": [1.9, 0.4, 0.5]}))
    base = RandomRnn(coin=1.0)
    counts = []
    for change in ({}, {"project": False}, {"connect": False}):
        settings = dataclasses.replace(base, **change)
        with open_search(planar_runtime, problem, 4, settings) as search:
            search.run(60, 10.0)
            counts.append(search.counts())
    assert counts[0].rollout_steps != counts[1].rollout_steps
    assert counts[0].heuristic > 0
    assert counts[2].heuristic == 0
