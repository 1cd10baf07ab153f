"""Search time against the number of obstacles, and with a cloud of points.

The PA10 through the 30 cm window; small boxes are strewn where the arm can
come, none nearer than 0.25 m to a recorded solution's spheres, so that the
problem stays the same while the broad phase has ever more to leave out.
The cloud is the wall's surface as points with 100 thousand more around.
"""

import json
import pathlib
import sys
import tempfile
import time

import numpy as np

import rrnn_opt as rr
from rrnn_opt.planning import Problem, RandomRnn
from rrnn_opt.planning.search.cache import runtime_of
from rrnn_opt.planning.search.library import Search
from rrnn_opt.planning.search.request import pack
from rrnn_opt.scene.library import scenario
from rrnn_opt.validation.ending import ended

COUNTS = (1, 10, 100, 1000, 10_000)
POINTS = 100_000
SEEDS = 20
CLEAR = 0.25


def solution_centres():
    """Sphere centres along one solution, (n, 3), m."""
    result = rr.plan(Problem.from_dict(scenario("window").problem(0)), seed=0)
    kin = rr.Kinematics(rr.Robot.builtin("pa10"))
    import casadi as ca

    at = ca.Function("c", [kin.q], [kin.sphere_centres()])
    return np.concatenate([np.array(at(q)).T for q in result.trajectory["q"]])


def strewn(count, keep, rng):
    """Places at least ``CLEAR`` from the solution, (count, 3), m."""
    from scipy.spatial import cKDTree

    tree, found = cKDTree(keep), np.zeros((0, 3))
    while len(found) < count:
        drawn = rng.uniform([-1.2, -1.2, -0.2], [1.2, 1.2, 1.6], (count, 3))
        found = np.concatenate([found, drawn[tree.query(drawn)[0] > CLEAR]])
    return found[:count]


def measured(problem):
    """CPU time of the search alone, its steps, and how many found a path."""
    runtime = runtime_of(problem.robot, RandomRnn().cell)
    times, steps, found = [], [], 0
    for seed in range(SEEDS):
        packed = pack(problem, (), problem.goals, seed)
        begin = time.thread_time()
        with Search(runtime, RandomRnn(), packed.struct, packed.keep) as search:
            found += search.run(20_000, 20.0) == "solved"
            counts = search.counts()
        times.append(1e3 * (time.thread_time() - begin))
        steps.append(counts.rollout_steps)
    p50, p95 = np.percentile(times, [50, 95])
    return {
        "found": found,
        "of": SEEDS,
        "p50_ms": float(p50),
        "p95_ms": float(p95),
        "steps": float(np.median(steps)),
        "step_us": 1e3 * float(np.sum(times) / np.sum(steps)),
    }


def main():
    base, rng = scenario("window").problem(0), np.random.default_rng(0)
    keep, rows = solution_centres(), []
    for count in COUNTS:
        places = strewn(count, keep, rng)
        more = [
            {"type": "box", "size": [0.02] * 3, "position": p.tolist()} for p in places
        ]
        problem = Problem.from_dict({**base, "obstacles": base["obstacles"] + more})
        rows.append({"obstacles": count, **measured(problem)})
        print(rows[-1], file=sys.stderr)
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "cloud.npy"
        np.save(path, strewn(POINTS, keep, rng))
        cloud = {"type": "points", "path": str(path), "radius": 0.01, "name": "cloud"}
        problem = Problem.from_dict({**base, "obstacles": [*base["obstacles"], cloud]})
        rows.append({"points": POINTS, **measured(problem)})
        print(rows[-1], file=sys.stderr)
    print(json.dumps(rows, indent=1))


if __name__ == "__main__":
    sys.exit(ended(main))
