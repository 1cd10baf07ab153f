"""Figure 2 shows what it says: one way ends short of the goal, the other at it."""

import numpy as np

from rrnn_opt.validation.figures import figure_2


def test_stuck_and_through():
    problem, stuck, through = figure_2.ways()
    goal = np.array(figure_2.PROBLEM["goal"]["position"][:2])
    ends = [figure_2.outlines(problem, way[-1:])[0, -1] for way in (stuck, through)]
    assert np.linalg.norm(ends[0] - goal) > 0.5
    assert np.linalg.norm(ends[1] - goal) < 1e-3
    np.testing.assert_array_equal(stuck[0], problem.start)
    assert len(stuck) > 10
    halves = figure_2.resampled(np.array([[0.0], [3.0], [4.0]]), 3)
    np.testing.assert_allclose(halves.ravel(), [0.0, 2.0, 4.0])
