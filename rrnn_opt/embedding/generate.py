"""From network dynamics to a C99 package."""

from __future__ import annotations

import math
from importlib import metadata
from typing import Any

import numpy as np

from rrnn_opt.dynamics import Dynamics
from rrnn_opt.embedding import render
from rrnn_opt.embedding.kernel import Field, Kernel, kernel
from rrnn_opt.embedding.package import Package, with_manifest
from rrnn_opt.embedding.vectors import STEP_SIZE, reference_vectors, tolerance
from rrnn_opt.embedding.words import require_prefix
from rrnn_opt.emit.prologue import Real, require_real
from rrnn_opt.errors import RrnnError

MAX_STEPS = 100_000


def generate(
    dynamics: Dynamics,
    *,
    prefix: str = "arm",
    real: Real = "float",
    steps: int = 1,
    step_size: float | None = None,
) -> Package:
    """Make a C99 package of a network: ``steps`` Euler steps in one call.

    The step is x+ = x + h f(x, parameters), emitted from the same expression
    graph that is simulated and proved.  Nothing in the package depends on the
    date or the machine: the same model gives the same bytes.

    Args:
        dynamics: the network.
        prefix: of every exported C name; a C identifier.
        real: "float" or "double".
        steps: Euler steps of one call, at least 1.
        step_size: h, s, that the package offers as a constant and is tested
            with; without one the user of the package gives it at run time.

    Returns:
        The package; ``.write(out_dir)`` makes its folder.

    Raises:
        RrnnError: prefix, real, steps or step size cannot be used.
        UnsupportedOperationError: the graph holds an operation without C text.
    """
    require_real(real)
    require_prefix(prefix)
    _require_steps(steps, step_size, real)
    core = kernel(dynamics)
    tested = STEP_SIZE if step_size is None else step_size
    if real == "float":
        tested = float(np.float32(tested))
    vectors = reference_vectors(
        core, steps=steps, step_size=tested, single=real == "float"
    )
    close = tolerance(
        core, vectors, steps=steps, step_size=tested, single=real == "float"
    )
    words = render.common_words(
        core, prefix=prefix, real=real, steps=steps, step_size=step_size
    )
    files = {
        f"include/{prefix}.h": render.header(core, words),
        f"src/{prefix}.c": render.source(core, words, real),
        "test/test_host.c": render.host_test(core, vectors, words, real, tested, close),
        "README.md": render.readme(core, words, real, close),
        "LICENSE": render.licence(),
    }
    options = {"real": real, "steps": steps, "step_size": step_size}
    return with_manifest(prefix, files, _facts(core, prefix, options))


def _require_steps(steps: int, step_size: float | None, real: Real) -> None:
    if isinstance(steps, bool) or not isinstance(steps, int):
        raise RrnnError(f"steps {steps!r}: it must be a whole number")
    if not 1 <= steps <= MAX_STEPS:
        raise RrnnError(f"steps {steps}: it must lie between 1 and {MAX_STEPS}")
    if step_size is None:
        return
    if not math.isfinite(step_size) or step_size <= 0.0:
        raise RrnnError(f"step size {step_size}: it must be positive and finite")
    if real == "float" and not 1e-30 < step_size < 1e30:
        raise RrnnError(f"step size {step_size}: it does not fit into a C float")


def _facts(core: Kernel, prefix: str, options: dict[str, Any]) -> dict[str, Any]:
    form = core.dynamics.formulation
    return {
        "prefix": prefix,
        "model_hash": core.tape.fingerprint,
        "network": core.dynamics.name,
        "formulation": None
        if form is None
        else {
            "name": form.name,
            "fingerprint": form.fingerprint,
            "citation": form.citation,
        },
        "options": options,
        "operations_per_step": core.tape.n_values,
        "state": _row(core.state),
        "inputs": [_row(field) for field in core.inputs],
        "output": _row(core.output),
        "versions": {name: metadata.version(name) for name in ("rrnn_opt", "casadi")},
    }


def _row(field: Field) -> dict[str, Any]:
    return {
        "name": field.name,
        "shape": list(field.shape),
        "unit": field.unit,
        "meaning": field.meaning,
    }
