"""A named CasADi function, as the runtime calls it."""

from __future__ import annotations

import casadi as ca


def emitted_function(
    name: str, inputs: dict[str, ca.SX], outputs: dict[str, ca.SX]
) -> ca.Function:
    """A function that is emitted under its own name, results dense."""
    return ca.Function(
        name,
        list(inputs.values()),
        [ca.densify(value) for value in outputs.values()],
        list(inputs),
        list(outputs),
    )
