"""Reference vectors: what the package must compute, in its own precision."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.embedding.kernel import Kernel
from rrnn_opt.embedding.options import Options
from rrnn_opt.errors import RrnnError
from rrnn_opt.symbolic.interpreter import evaluate

Array = NDArray[np.float64]
SELFTEST_CASES = 4
HOST_CASES = 24
LEAST = {False: 1e-12, True: 1e-4}
"""Least tolerance of the package's test in double and in single precision."""
_TRIALS = 4000
_SPREADS = (0.1, 0.5, 1.0, 0.02)


@dataclass(frozen=True, eq=False)
class Vector:
    """One case: arguments, and the results after all steps of a call.

    Values are those of the model's operations in the package's precision, held
    in double, so that they are written and compared to the bit.

    Attributes:
        state: before, (n,).
        inputs: one array a parameter, column-major.
        next: state after, (n,).
        output: output after, (m,).
        merit: V before the last step.
    """

    state: Array
    inputs: tuple[Array, ...]
    next: Array
    output: Array
    merit: float


def step_of(options: Options) -> float:
    """Step size that a package is tested with, s, as a number of its type."""
    step = options.test_step if options.step_size is None else options.step_size
    return float(np.float32(step)) if options.single else step


def reference_vectors(
    kernel: Kernel,
    options: Options,
    *,
    cases: int = HOST_CASES,
    seed: int = 0,
) -> list[Vector]:
    """Seeded cases whose limits are not empty, active bounds among them.

    Args:
        kernel: the step.
        options: precision, steps and step size.
        cases: how many.
        seed: of the generator.

    Raises:
        RrnnError: no arguments were found at which the limits are not empty.
    """
    rng = np.random.default_rng(seed)
    found: list[Vector] = []
    for trial in range(_TRIALS):
        spread = _SPREADS[trial % len(_SPREADS)]
        sizes = [kernel.state.size, *(field.size for field in kernel.inputs)]
        drawn = [spread * rng.standard_normal(size) for size in sizes]
        if options.single:
            drawn = [x.astype(np.float32).astype(np.float64) for x in drawn]
        case = run_tape(kernel, options, drawn[0], tuple(drawn[1:]))
        if case is not None:
            found.append(case)
        if len(found) == cases:
            return found
    raise RrnnError(
        f"generate: {_TRIALS} random arguments of '{kernel.dynamics.name}' left the"
        " limits empty or the result not finite, so there is nothing to test with"
    )


def run_tape(
    kernel: Kernel, options: Options, state: Array, inputs: tuple[Array, ...]
) -> Vector | None:
    """One call by the tape's interpreter; None where the package would refuse.

    Args:
        kernel: the step.
        options: precision, steps and step size.
        state: (n,), numbers of the package's type.
        inputs: one column-major array a parameter, likewise.
    """
    dtype = np.float32 if options.single else np.float64
    following = state
    for _ in range(options.steps):
        results = evaluate(
            kernel.tape, _arguments(kernel, options, following, inputs), dtype
        )
        values = [np.ravel(r, order="F").astype(np.float64) for r in results]
        following = values[0]
    if not all(np.all(np.isfinite(v)) for v in values):
        return None
    if kernel.bounds and values[6][0] < 0.0:
        return None
    return Vector(state, inputs, following, values[1], float(values[2][0]))


def tolerance(kernel: Kernel, options: Options, vectors: Sequence[Vector]) -> float:
    """What single rounding may cost, relative to the larger of 1 and x.

    Four times the largest distance between the vectors and the same cases by
    CasADi in double precision, and no less than ``LEAST``: an ill-conditioned
    law is told from a wrong one.

    Args:
        kernel: the step.
        options: precision, steps and step size.
        vectors: the cases.
    """
    worst = 0.0
    for vector in vectors:
        following = vector.state
        for _ in range(options.steps):
            arguments = _arguments(kernel, options, following, vector.inputs)
            results = kernel.function.call(arguments)
            values = [np.asarray(v, dtype=np.float64).ravel("F") for v in results]
            following = values[0]
        for got, want in ((vector.next, following), (vector.output, values[1])):
            scale = np.maximum(np.abs(want), 1.0)
            worst = max(worst, float(np.max(np.abs(got - want) / scale, initial=0.0)))
    return max(LEAST[options.single], float(f"{4.0 * worst:.1g}"))


def _arguments(
    kernel: Kernel, options: Options, state: Array, inputs: tuple[Array, ...]
) -> list[Array]:
    shaped = [
        given.reshape(field.shape, order="F")
        for given, field in zip(inputs, kernel.inputs, strict=True)
    ]
    return [state, *shaped, np.array([step_of(options)])]
