"""Obstacles as further tasks, and as wishes of self-motion."""

import numpy as np
import pytest
import qpsolvers

from rrnn_opt.errors import RrnnError
from rrnn_opt.formulations import (
    gradient_projection,
    task_augmentation,
)
from tests.formulations.points import (
    jacobian,
    parameters,
    roomy,
    solve,
    sphere_jacobian,
)

LEFT_WALL = np.array([[1.0], [0.0], [0.0]])  # outward normal of a wall at the left


def last(kin):
    return len(kin.robot.spheres) - 1


def test_task_augmentation_makes_the_clearance_grow_as_asked(every):
    sphere = last(every) // 2
    form = task_augmentation(every, contacts=(sphere,), gamma=2.0, safe=0.05)
    given = roomy(form, every, 6, clearances=np.array([0.049]))
    u = solve(form, given)
    J = jacobian(every, given["q"])
    rate = given["normals"].T @ sphere_jacobian(every, sphere, given["q"]) @ u
    np.testing.assert_allclose(rate, 2.0 * 0.001, atol=1e-7)
    np.testing.assert_allclose(J @ u, given["rd_dot"], atol=1e-8)
    far = form.qp.at(**given | {"clearances": np.array([0.051])})
    assert not far.A[3].any()
    assert far.b[3] == 0.0


def test_with_all_redundancy_used_up_the_solution_is_unique(planar3):
    sphere = last(planar3) // 2
    form = task_augmentation(planar3, contacts=(sphere,), safe=0.05)
    given = roomy(form, planar3, 7, clearances=np.array([0.05]))
    square = form.qp.at(**given).A[[0, 1, 3]]
    right = form.qp.at(**given).b[[0, 1, 3]]
    np.testing.assert_allclose(
        solve(form, given), np.linalg.solve(square, right), atol=1e-9
    )


def test_more_rows_than_spare_degrees_of_freedom_are_refused(planar3, pa10):
    with pytest.raises(RrnnError, match="2 rows, but only 1 to spare"):
        task_augmentation(planar3, contacts=(0, 1))
    task_augmentation(pa10, contacts=(20, 30, 40, 42))
    with pytest.raises(RrnnError, match="5 rows, but only 4 to spare"):
        task_augmentation(pa10, contacts=(10, 20, 30, 40, 42))


# gradient projection


def test_gradient_projection_is_the_classical_formula(every):
    chosen = (last(every) // 2, last(every))
    form = gradient_projection(every, contacts=chosen, gain=0.5, influence=0.1)
    given = parameters(form, every, 8) | {"clearances": np.array([0.03, 0.2])}
    J = jacobian(every, given["q"])
    pinv = np.linalg.pinv(J)
    nearer = sphere_jacobian(every, chosen[0], given["q"])
    u0 = 0.5 * (1 - 0.3) * nearer.T @ given["normals"][:, 0]
    classical = pinv @ given["rd_dot"] + (np.eye(len(u0)) - pinv @ J) @ u0
    np.testing.assert_allclose(solve(form, given), classical, atol=1e-7)
    assert not form.inverse
    plain = gradient_projection(every)
    only = {name: given[name] for name in ("q", "rd_dot")}
    np.testing.assert_allclose(solve(plain, only), pinv @ given["rd_dot"], atol=1e-8)


def test_gradient_projection_may_run_into_what_it_shuns(planar3):
    """The wish is bounded; a task towards the wall is not slowed by it."""
    sphere = last(planar3)
    form = gradient_projection(planar3, contacts=(sphere,))
    q = np.array([1.3, 0.3, 0.4])
    given = {"q": q, "rd_dot": np.array([-0.1, 0.0, 0.0]), "normals": LEFT_WALL}
    problem = form.qp.at(**given, clearances=np.array([0.0]))
    u = qpsolvers.solve_problem(problem, solver="daqp").x
    assert (LEFT_WALL.T @ sphere_jacobian(planar3, sphere, q) @ u).item() < -0.05
