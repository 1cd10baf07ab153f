"""The step in C is the dual network of ``formulations/slide.py``, step by step."""

from dataclasses import dataclass

import casadi as ca
import numpy as np
import pytest
import qpsolvers

import rrnn_opt as rr
from rrnn_opt.formulations import slide
from rrnn_opt.networks import MemoryCell
from rrnn_opt.planning import Problem, RandomRnn
from rrnn_opt.planning.kernel import source as kernel
from rrnn_opt.planning.search.library import Runtime

SETTINGS = RandomRnn()
CONVERGED = RandomRnn(sweeps=100_000, sweep_least=1e-13, passes=60)
FAR = 10.0
"""Clearance of a contact that is not there, m."""


@dataclass
class Programme:
    """Rows and box of ``slide`` through CasADi, for steps with any contacts."""

    robot: rr.Robot
    repeats: int

    def __post_init__(self):
        spheres = [
            s for s in range(len(self.robot.spheres)) for _ in range(self.repeats)
        ]
        form = slide(rr.Kinematics(self.robot), spheres)
        self.spheres = np.array(spheres)
        arguments = [p.sx for p in form.parameters]
        qp = form.qp
        self.rows = ca.Function("rows", arguments, [qp.G, qp.h, qp.lb, qp.ub, qp.q])

    def at(self, q, wish, pairs, settings):
        """``G u <= h``, box and cost; contacts that are not there lie far away."""
        count = len(self.spheres)
        normals, gaps = np.tile([[1.0], [0.0], [0.0]], count), np.full(count, FAR)
        bounds, taken = np.zeros(count), set()
        for p in pairs:
            free = next(
                i for i in np.flatnonzero(self.spheres == p.sphere) if i not in taken
            )
            taken.add(free)
            normals[:, free], gaps[free], bounds[free] = p.normal, p.gap, p.bound
        numbers = (settings.steering_margin, settings.max_step)
        values = self.rows(q, wish, normals, gaps, bounds, *numbers)
        G, h, lower, upper, cost = (np.array(v) for v in values)
        kept = sorted(taken)
        return G[kept], h[kept, 0], lower[:, 0], upper[:, 0], -cost[:, 0]


def dual_network(G, h, lower, upper, wish, settings):
    """The rows that u violates, worst first, swept; then the next ones."""
    u, z = wish.copy(), np.zeros(len(wish))
    _box(u, z, lower, upper)
    chosen, duals = [], np.zeros(0)
    for _ in range(settings.passes):
        slack = h - G @ u
        open_rows = [i for i in np.argsort(slack) if slack[i] < -1e-9]
        new = [i for i in open_rows if i not in chosen][: settings.rows_per_pass]
        if not new:
            break
        chosen += new
        duals = np.append(duals, np.zeros(len(new)))
        duals, z, u = _swept(G[chosen], h[chosen], lower, upper, duals, z, u, settings)
    length = np.linalg.norm(u)
    return u * min(1.0, settings.max_step / length) if length else u


def _box(u, z, lower, upper):
    free = u - z
    u[:] = np.clip(free, lower, upper)
    z[:] = u - free


def _swept(G, h, lower, upper, duals, z, u, settings):
    squares = np.sum(G**2, axis=1)
    for _ in range(settings.sweeps):
        before = u.copy()
        for i in np.flatnonzero(squares > 1e-12):
            change = max(duals[i] + (G[i] @ u - h[i]) / squares[i], 0.0) - duals[i]
            duals[i] += change
            u = u - change * G[i]
        _box(u, z, lower, upper)
        if np.array_equal(u, before):
            break
    return duals, z, u


def recorded(search, robot, rng, count):
    """Steps of slides from free postures towards random ones: q, wish, u, pairs."""
    made = 0
    while made < count:
        q = rng.uniform(robot.limits.lower, robot.limits.upper)
        if not search.postures_free(q)[0]:
            continue
        target = rng.uniform(robot.limits.lower, robot.limits.upper)
        for _ in range(40):
            wish = target - q
            if np.linalg.norm(wish) < 1e-3:
                break
            wish *= min(1.0, SETTINGS.max_step / np.linalg.norm(wish))
            u, pairs = search.step(q, wish)
            if any(p.group >= 0 for p in pairs) or np.linalg.norm(u) < 1e-3:
                break
            yield q, wish, u, pairs
            made += 1
            q = q + u
            if made == count or not search.postures_free(q)[0]:
                break


@pytest.mark.slow
def test_ten_thousand_steps_equal_the_formulations_dual_network(
    pa10, pa10_runtime, window_problem, open_search, rng
):
    problem = Problem.from_dict(window_problem())
    programme, held = Programme(pa10, 4), 0
    with open_search(pa10_runtime, problem) as search:
        for q, wish, u, pairs in recorded(search, pa10, rng, 10_000):
            *rows, pull = programme.at(q, wish, pairs, SETTINGS)
            np.testing.assert_array_equal(pull, wish)
            ours = dual_network(*rows, wish, SETTINGS)
            np.testing.assert_allclose(u, ours, atol=1e-10)
            held += bool(np.linalg.norm(u - wish) > 1e-6)
    assert held > 1000


@pytest.mark.slow
def test_swept_to_convergence_it_is_the_optimum_and_the_cut_is_small(
    pa10, pa10_runtime, window_problem, open_search, rng
):
    problem = Problem.from_dict(window_problem())
    programme, seen, gaps = Programme(pa10, 4), 0, []
    with (
        open_search(pa10_runtime, problem) as search,
        open_search(pa10_runtime, problem, settings=CONVERGED) as converged,
    ):
        for q, wish, cut, pairs in recorded(search, pa10, rng, 2000):
            u, _ = converged.step(q, wish)
            G, h, lower, upper, _ = programme.at(q, wish, pairs, CONVERGED)
            qp = qpsolvers.Problem(np.eye(7), -wish, G, h, lb=lower, ub=upper)
            settings = {"primal_tol": 1e-12, "dual_tol": 1e-12}
            answer = qpsolvers.solve_problem(qp, solver="daqp", **settings)
            if not answer.found or np.linalg.norm(answer.x) > CONVERGED.max_step:
                continue
            active = np.max(answer.z, initial=0.0) > 1e-9
            if not active or np.linalg.cond(G[answer.z > 1e-9]) > 30.0:
                continue
            seen += 1
            np.testing.assert_allclose(u, answer.x, atol=1e-8)
            gaps.append(np.linalg.norm(cut - answer.x))
    assert seen > 100
    assert np.max(gaps) > 0.0  # the sweeps are cut off, and nothing proved needs them
    assert np.median(gaps) < 1e-3


@pytest.mark.parametrize("part", ["row", "offset"])
def test_a_sign_flipped_in_the_formulation_changes_the_plan(
    part, pa10, pa10_runtime, window_problem, open_search, monkeypatch
):
    problem = Problem.from_dict(window_problem())
    honest = getattr(kernel, part)
    monkeypatch.setattr(kernel, part, lambda *arguments: -honest(*arguments))
    paths = []
    for runtime in (pa10_runtime, Runtime(pa10, MemoryCell())):
        with open_search(runtime, problem) as search:
            found = search.run(100, 5.0)
            paths.append(search.path() if found == "solved" else None)
    assert paths[0] is not None
    assert paths[1] is None or not np.array_equal(*paths)
