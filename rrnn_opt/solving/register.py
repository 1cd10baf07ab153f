"""A settled network as a back end of qpsolvers, entered there when asked to."""

from __future__ import annotations

import time
from typing import Any

from numpy.typing import ArrayLike

from rrnn_opt.errors import RrnnError
from rrnn_opt.solving.dense import Answer, settle_dense
from rrnn_opt.solving.parts import Dense

NAME = "rrnn"


def register_qpsolvers(name: str = NAME) -> None:
    """Make ``solver="rrnn"`` known to ``qpsolvers``, and so to what builds on it.

    Nothing is entered on import.  A second call changes nothing.

    Args:
        name: under which qpsolvers is to know it.

    Raises:
        RrnnError: qpsolvers has another back end of that name.
    """
    from qpsolvers import available_solvers, dense_solvers
    from qpsolvers.solvers import solve_function

    if solve_function.get(name, solve_problem) is not solve_problem:
        raise RrnnError(f"qpsolvers has a solver '{name}' already; give another name")
    solve_function[name] = solve_problem
    for table in (available_solvers, dense_solvers):
        if name not in table:
            table.append(name)


def unregister_qpsolvers(name: str = NAME) -> None:
    """Take back ``register_qpsolvers``; nothing happens where it was not called.

    Args:
        name: as given there.
    """
    from qpsolvers import available_solvers, dense_solvers
    from qpsolvers.solvers import solve_function

    if solve_function.get(name) is not solve_problem:
        return
    del solve_function[name]
    for table in (available_solvers, dense_solvers):
        table.remove(name)


def solve_problem(
    problem: Any,
    initvals: ArrayLike | None = None,
    verbose: bool = False,
    *,
    tolerance: float = 1e-6,
    max_steps: int = 200_000,
) -> Any:
    """Settle a network on a dense QP; what ``qpsolvers.solve_problem`` calls.

    Args:
        problem: ``qpsolvers.Problem`` with P positive semidefinite.
        initvals: (n,) point to start from.
        verbose: ignored; nothing is ever printed.
        tolerance: on our absolute KKT residual of ``problem``; ``found`` is
            True only within it.
        max_steps: Euler steps for one choice of the step size.

    Returns:
        ``qpsolvers.Solution`` with x, y, z, z_box in its signs, and in
        ``extras`` our "status", "kkt_residual", Euler "steps" and "newton" steps.

    Raises:
        qpsolvers.ProblemError: P is not positive semidefinite, a number is
            NaN, or the problem is too large to be written out as C.
    """
    from qpsolvers import ProblemError

    del verbose
    begin = time.perf_counter()
    try:
        answer = settle_dense(
            Dense.of(problem),
            initvals=initvals,
            tolerance=tolerance,
            max_steps=max_steps,
        )
    except RrnnError as error:
        raise ProblemError(str(error)) from error
    return _solution(problem, answer, tolerance, time.perf_counter() - begin)


def _solution(problem: Any, answer: Answer, tolerance: float, time_s: float) -> Any:
    """The answer in qpsolvers' words; numbers only where they passed our check."""
    from qpsolvers import Solution

    solution = Solution(problem)
    solution.solve_time = time_s
    solution.extras = {
        "status": answer.status.key,
        "kkt_residual": answer.residual.worst,
        "steps": answer.steps,
        "newton": answer.newton,
    }
    solution.found = answer.residual.worst <= tolerance
    if solution.found:
        solution.x, solution.obj = answer.x, _objective(problem, answer)
        solution.y, solution.z = answer.duals.y, answer.duals.z
        solution.z_box = answer.duals.z_box
    return solution


def _objective(problem: Any, answer: Answer) -> float:
    qp = Dense.of(problem)
    return float(answer.x @ (0.5 * qp.P @ answer.x + qp.q))
