"""An end that is asked for comes within 50 ms, also among 100 thousand points."""

import os
import signal
import threading
import time

import numpy as np
import pytest

from rrnn_opt.planning import Problem, plan
from rrnn_opt.planning.search.library import Search

AT_ONCE = 0.05
"""What a caller waits for at most, s of the process's own time."""
READY = [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]
BOARDS = (
    ([0.6, 0.0, 0.0], [0.8, 0.0, 0.0], [0.0, 1.4, 0.0]),
    ([0.75, 0.0, 0.4], [0.4, 0.0, 0.0], [0.0, 1.0, 0.0]),
    ([0.75, 0.0, 0.75], [0.4, 0.0, 0.0], [0.0, 1.0, 0.0]),
    ([0.95, 0.0, 0.4], [0.0, 0.0, 0.8], [0.0, 1.0, 0.0]),
)
"""Middle and two edges of a table and the boards of a shelf, m."""


def among(points, folder, goal):
    """The Panda between points of 4 mm radius."""
    file = folder / "cloud.npy"
    np.save(file, points)
    cloud = {"name": "cloud", "type": "points", "path": str(file), "radius": 0.004}
    data = {"robot": "panda", "start": READY, "goal": {"position": goal}}
    return Problem.from_dict({**data, "obstacles": [cloud]})


@pytest.fixture(scope="module")
def shelf(tmp_path_factory):
    share = np.random.default_rng(0).uniform(-0.5, 0.5, (4, 25_000, 2))
    boards = [m + s @ np.array(e) for s, (m, *e) in zip(share, BOARDS, strict=True)]
    folder = tmp_path_factory.mktemp("shelf")
    return among(np.concatenate(boards), folder, [0.68, 0.1, 0.56])


@pytest.fixture
def ctrl_c():
    """Press it once the process has worked for a while; tells how much since, s.

    The time is the process's own: on a busy machine another clock would run out
    before the search has begun.
    """
    pressed, threads = [], []

    def press(moment):
        while time.process_time() < moment:
            time.sleep(1e-3)
        pressed.append(time.process_time())
        os.kill(os.getpid(), signal.SIGINT)

    def after(seconds):
        moment = time.process_time() + seconds
        threads.append(threading.Thread(target=press, args=(moment,)))
        threads[-1].start()
        return lambda: time.process_time() - pressed[0]

    yield after
    for thread in threads:
        thread.join()


@pytest.mark.slow
def test_a_goal_in_the_midst_of_points_is_given_up_soon(tmp_path):
    """A posture's first collision is enough: not all pairs in reach are listed."""
    spread = np.random.default_rng(0).uniform(-0.15, 0.15, (100_000, 3))
    middle = [0.55, 0.2, 0.5]
    problem = among(spread + middle, tmp_path, middle)
    begin = time.process_time()
    assert plan(problem).status in ("no_goal_posture", "infeasible")
    assert time.process_time() - begin < 5.0


def test_a_time_limit_ends_a_slide(shelf, panda_runtime, open_search):
    with open_search(panda_runtime, shelf) as search:
        begin = time.process_time()
        assert search.run(20_000, 10.0, 0.02) == "cancelled"
        assert time.process_time() - begin < 0.02 + AT_ONCE
    assert plan(shelf, time_limit=0.02).status == "time_limit"


def test_ctrl_c_ends_a_slide(shelf, panda_runtime, open_search, ctrl_c):
    with open_search(panda_runtime, shelf) as search:
        worked = ctrl_c(0.03)
        with pytest.raises(KeyboardInterrupt):
            search.run(20_000, 10.0)
        assert worked() < AT_ONCE


def test_ctrl_c_ends_shortening(shelf, panda_runtime, open_search, ctrl_c):
    with open_search(panda_runtime, shelf) as search:
        assert search.run(20_000, 60.0) == "solved"
        path = search.path()
        worked = ctrl_c(0.03)
        with pytest.raises(KeyboardInterrupt):
            search.shorten(path, 10**6)
        assert worked() < AT_ONCE


@pytest.mark.parametrize(
    ("handler", "status"),
    [(signal.SIG_IGN, "solved"), (lambda number, frame: None, "cancelled")],
)
def test_who_handles_ctrl_c_in_another_way_is_heeded(
    shelf, panda_runtime, open_search, ctrl_c, handler, status
):
    before = signal.signal(signal.SIGINT, handler)
    try:
        with open_search(panda_runtime, shelf) as search:
            ctrl_c(0.03)
            assert search.run(20_000, 60.0) == status
    finally:
        signal.signal(signal.SIGINT, before)


def test_a_cancelled_search_is_an_interrupted_plan(window_problem, monkeypatch):
    monkeypatch.setattr(Search, "run", lambda *_: "cancelled")
    assert plan(Problem.from_dict(window_problem())).status == "interrupted"


def test_a_limit_that_is_not_reached_changes_nothing(
    pa10_runtime, window_problem, open_search
):
    problem, paths = Problem.from_dict(window_problem()), []
    for limit in (np.inf, 600.0):
        with open_search(pa10_runtime, problem, seed=5) as search:
            assert search.run(3000, 60.0, limit) == "solved"
            paths.append(search.path())
    np.testing.assert_array_equal(*paths)
