"""Reference vectors: what the package must compute, evaluated by CasADi."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.embedding.kernel import Kernel
from rrnn_opt.errors import RrnnError
from rrnn_opt.symbolic.interpreter import evaluate

Array = NDArray[np.float64]
CASES = 8
STEP_SIZE = 0.001
LEAST = {False: 1e-12, True: 1e-4}
"""Least tolerance of the package's test in double and in single precision."""
_TRIALS = 1000


@dataclass(frozen=True, eq=False)
class Vector:
    """One case: arguments, and the results after all steps of a call.

    Attributes:
        state: before, (n,).
        inputs: one array a parameter, column-major.
        next: state after, (n,).
        output: output after, (m,).
    """

    state: Array
    inputs: tuple[Array, ...]
    next: Array
    output: Array


def reference_vectors(
    kernel: Kernel, *, steps: int, step_size: float, single: bool
) -> list[Vector]:
    """A few seeded cases whose limits are not empty.

    Args:
        kernel: the step.
        steps: Euler steps of one call.
        step_size: s.
        single: whether arguments are rounded to single precision.

    Raises:
        RrnnError: no arguments were found at which the limits are not empty.
    """
    rng = np.random.default_rng(0)
    found: list[Vector] = []
    for _ in range(_TRIALS):
        sizes = [kernel.state.size, *(field.size for field in kernel.inputs)]
        drawn = [0.5 * rng.standard_normal(size) for size in sizes]
        if single:
            drawn = [x.astype(np.float32).astype(np.float64) for x in drawn]
        case = _run(kernel, drawn[0], tuple(drawn[1:]), steps, step_size)
        if case is not None:
            found.append(case)
        if len(found) == CASES:
            return found
    raise RrnnError(
        f"generate: {_TRIALS} random arguments of '{kernel.dynamics.name}' left the"
        " limits empty or the result not finite, so there is nothing to test with"
    )


def tolerance(
    kernel: Kernel,
    vectors: Sequence[Vector],
    *,
    steps: int,
    step_size: float,
    single: bool,
) -> float:
    """What the package's own test may be off by, relative to the larger of 1 and x.

    Four times what the very same operations in the package's precision are off
    by, measured on the vectors with the tape's interpreter, and no less than
    ``LEAST``: an ill-conditioned law is told from a wrong one.

    Args:
        kernel: the step.
        vectors: the cases.
        steps: Euler steps of one call.
        step_size: s.
        single: whether the package computes in single precision.
    """
    least, dtype = LEAST[single], np.float32 if single else np.float64
    worst = 0.0
    for vector in vectors:
        following, output = vector.state, vector.output
        for _ in range(steps):
            shaped = [
                value.reshape(field.shape, order="F")
                for value, field in zip(vector.inputs, kernel.inputs, strict=True)
            ]
            arguments = [following, *shaped, np.array([step_size])]
            results = evaluate(kernel.tape, arguments, dtype)
            following, output = (np.ravel(r, order="F") for r in results[:2])
        for got, want in ((following, vector.next), (output, vector.output)):
            scale = np.maximum(np.abs(want), 1.0)
            error = np.abs(got.astype(np.float64) - want) / scale
            worst = max(worst, float(np.max(error, initial=0.0)))
    return max(least, float(f"{4.0 * worst:.1g}"))


def _run(
    kernel: Kernel,
    state: Array,
    inputs: tuple[Array, ...],
    steps: int,
    step_size: float,
) -> Vector | None:
    shaped = [
        value.reshape(field.shape, order="F")
        for value, field in zip(inputs, kernel.inputs, strict=True)
    ]
    following, output = state, state
    for _ in range(steps):
        results = kernel.function.call([following, *shaped, step_size])
        values = [np.asarray(v, dtype=np.float64).ravel(order="F") for v in results]
        following, output = values[0], values[1]
        if not all(np.all(np.isfinite(v)) for v in values[:3]):
            return None
        if kernel.bounds and np.any(values[3] > values[4]):
            return None
    return Vector(state, inputs, following, output)
