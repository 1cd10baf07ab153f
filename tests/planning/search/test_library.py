"""The runtime's steps and segments against independent answers."""

import itertools
import re
from pathlib import Path

import casadi as ca
import numpy as np
import pytest
import qpsolvers

import rrnn_opt as rr
from rrnn_opt.formulations import slide
from rrnn_opt.planning import Problem, RandomRnn
from rrnn_opt.planning.kernel.source import RUNTIME
from rrnn_opt.planning.search import library
from rrnn_opt.robot.motion_bound import motion_bound, travel
from rrnn_opt.robot.reach import ancestor_mask, reach

CONVERGED = RandomRnn(sweeps=20_000, passes=30)


def near_configurations(search, robot, rng, wanted):
    """Postures near two obstacles, no self pair near; the wish is a collision."""
    kin, found = rr.Kinematics(robot), 0
    centres = ca.vec(kin.sphere_centres())
    slopes = ca.Function("slopes", [kin.q], [ca.jacobian(centres, kin.q)])
    while found < wanted:
        q = rng.uniform(robot.limits.lower, robot.limits.upper)
        _, pairs = search.step(q, np.zeros(robot.nv))
        obstacles = [p for p in pairs if p.group < 0]
        if len(obstacles) < 2 or len(obstacles) < len(pairs):
            continue
        closest = min(pairs, key=lambda p: p.gap)
        rows = np.array(slopes(q))[3 * closest.sphere :][:3]
        wish = -closest.normal @ rows + 0.3 * rng.normal(size=robot.nv)
        wish *= 0.1 / np.linalg.norm(wish)
        u, pairs = search.step(q, wish)
        if 0.002 < closest.gap < 0.05:
            found += 1
            yield q, wish, u, pairs


def test_a_converged_step_is_the_optimum_of_the_slide_formulation(
    pa10, pa10_runtime, window_problem, open_search, rng
):
    problem = Problem.from_dict(window_problem())
    kin, active = rr.Kinematics(pa10), 0
    with open_search(pa10_runtime, problem, settings=CONVERGED) as search:
        for q, wish, u, pairs in near_configurations(search, pa10, rng, 30):
            form = slide(kin, [p.sphere for p in pairs])
            qp = form.qp.at(
                q=q,
                attraction=wish,
                normals=np.column_stack([p.normal for p in pairs]),
                clearances=[p.gap for p in pairs],
                bounds=[p.bound for p in pairs],
                steering_margin=[CONVERGED.steering_margin],
                radius=[CONVERGED.max_step],
            )
            answer = qpsolvers.solve_problem(qp, solver="daqp")
            if not answer.found or np.linalg.norm(answer.x) > CONVERGED.max_step:
                continue
            active += bool(np.max(answer.z, initial=0.0) > 1e-9)
            np.testing.assert_allclose(u, answer.x, atol=1e-6)
    assert active >= 10


def test_gaps_change_as_the_rows_say(
    pa10, pa10_runtime, window_problem, open_search, rng
):
    problem, kin = Problem.from_dict(window_problem()), rr.Kinematics(pa10)
    centres = ca.vec(kin.sphere_centres())
    slopes = ca.Function("slopes", [kin.q], [ca.jacobian(centres, kin.q)])
    with open_search(pa10_runtime, problem) as search:
        for q, _, _, pairs in near_configurations(search, pa10, rng, 10):
            direction = rng.normal(size=7) * 1e-6
            moved = {
                (p.sphere, p.other): p.gap for p in search.step(q + direction, q * 0)[1]
            }
            for p in pairs:
                rows = np.array(slopes(q))[3 * p.sphere :][:3]
                predicted = p.normal @ rows @ direction
                change = moved[p.sphere, p.other] - p.gap
                assert change == pytest.approx(predicted, abs=1e-9)


def each_sphere(robot, bound, u):
    """A bound on the motion of each sphere for the step u, (n, 1)."""
    levers, mask = reach(robot), ancestor_mask(robot).astype(float)
    columns = zip(levers.T, mask.T, strict=True)
    return ca.vertcat(*(bound(robot.tree, u, ca.SX(a), ca.SX(b)) for a, b in columns))


@pytest.mark.parametrize("name", ["pa10", "panda", "raven2", "planar3"])
def test_remainder_never_exceeds_the_motion_bound(name, rng):
    robot = rr.Robot.builtin(name)
    kin, u = rr.Kinematics(robot), ca.SX.sym("u", robot.nv)
    both = ca.Function(
        "bounds", [u], [each_sphere(robot, f, u) for f in (motion_bound, travel)]
    )
    centres = ca.Function("c", [kin.q], [kin.sphere_centres()])
    tangent = ca.Function(
        "t", [kin.q, u], [ca.jtimes(ca.vec(kin.sphere_centres()), kin.q, u)]
    )
    lower = np.maximum(robot.limits.lower, -3.0)
    upper = np.minimum(robot.limits.upper, 3.0)
    worst = 0.0
    for _ in range(300):
        q, goal = rng.uniform(lower, upper), rng.uniform(lower, upper)
        step = rng.uniform(0.02, 0.6) * (goal - q)
        moved = np.array(centres(q + step)) - np.array(centres(q))
        first = np.array(tangent(q, step)).reshape(3, -1, order="F")
        bound, way = (np.array(v).ravel() for v in both(step))
        rest = np.linalg.norm(moved - first, axis=0)
        assert np.all(rest <= bound / 2 + 1e-12)
        assert np.all(np.linalg.norm(moved, axis=0) <= way + 1e-12)
        worst = max(worst, np.max(rest / np.maximum(bound / 2, 1e-12)))
    assert worst > 0.2  # the bound is of use, not merely true


def test_proved_segments_are_free_and_blocked_ones_are_not_proved(
    pa10, pa10_runtime, window_problem, open_search, rng
):
    problem = Problem.from_dict(window_problem())
    counts = [0, 0]
    with open_search(pa10_runtime, problem) as search:
        for _ in range(150):
            a = rng.uniform(pa10.limits.lower, pa10.limits.upper)
            b = a + rng.normal(size=7) * 0.3
            proved = search.segment_free(a, b)
            gaps = [search.closest(a + s * (b - a)) for s in np.linspace(0, 1, 400)]
            least = min((c.gap for c in gaps if c is not None), default=1.0)
            counts[proved] += 1
            assert (least > 0.0) if proved else (least < 1e-3)
    assert min(counts) > 20


def test_runtime_holds_no_formula():
    """No trigonometric function, robot constant or distance formula."""
    room = Path(rr.__file__).parent / "planning" / "runtime"
    for name in RUNTIME:
        text = re.sub(r"/\*.*?\*/", "", (room / name).read_text(), flags=re.S)
        calls = set(re.findall(r"\b([a-z_0-9]+)\s*\(", text))
        banned = {"sin", "cos", "tan", "atan2", "acos", "asin", "sqrt", "exp", "hypot"}
        assert not banned & {c.rstrip("f") for c in calls}, name
        numbers = set(re.findall(r"(?<![\w.])\d+\.\d+(?:e[-+]?\d+)?", text))
        known = {"0.0", "0.5", "1.0", "2.0", "1.25", "1.6", "9007199254740992.0"}
        assert numbers <= known | {"1e300"}, (name, numbers)


def test_a_planner_built_for_a_cpu_without_masks_proves_its_way(
    pa10, pa10_runtime, window_problem, open_search, monkeypatch
):
    monkeypatch.setattr(library, "cpu_name", lambda: "x86_64 avx2")
    unmasked = library.Runtime(pa10, RandomRnn().cell)
    problem = Problem.from_dict(window_problem())
    with open_search(unmasked, problem) as search:
        assert search.run(20_000, 10.0) == "solved"
        path = search.path()
    with open_search(pa10_runtime, problem) as search:
        assert all(search.segment_free(a, b) for a, b in itertools.pairwise(path))
