"""Reference vectors: what the package must compute, evaluated by CasADi."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.embedding.kernel import Kernel
from rrnn_opt.errors import RrnnError

Array = NDArray[np.float64]
CASES = 8
STEP_SIZE = 0.001
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
