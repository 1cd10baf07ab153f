"""Random expression graphs and boxes for soundness tests."""

from __future__ import annotations

import casadi as ca
import numpy as np

UNARY = ("neg", "sq", "sin", "cos", "fabs", "sqrt", "inv", "sign", "not", "cube")
BINARY = ("add", "sub", "mul", "div", "fmin", "fmax", "lt", "le", "if", "and", "or")
SMOOTH = ("neg", "sq", "sin", "cos", "cube"), ("add", "sub", "mul")


def random_graph(
    rng: np.random.Generator, *, inputs: int = 3, steps: int = 12
) -> ca.Function:
    """A function of a column with one result, built of random operations.

    One graph in two holds smooth operations only, so that bounded ones abound.
    """
    unary, binary = SMOOTH if rng.random() < 0.5 else (UNARY, BINARY)
    x = ca.SX.sym("x", inputs)
    values = [x[k] for k in range(inputs)]
    values.append(ca.SX(float(np.round(rng.normal(), 3))))
    for _ in range(steps):
        a, b = (values[k] for k in rng.integers(len(values), size=2))
        if rng.random() < 0.45:
            values.append(_one(str(rng.choice(unary)), a))
        else:
            values.append(_two(str(rng.choice(binary)), a, b))
    return ca.Function("graph", [x], [values[-1]], ["x"], ["y"])


def _one(name: str, a: ca.SX) -> ca.SX:
    return {
        "neg": lambda: -a,
        "sq": lambda: a * a,
        "sin": lambda: ca.sin(a),
        "cos": lambda: ca.cos(a),
        "fabs": lambda: ca.fabs(a),
        "sqrt": lambda: ca.sqrt(a),
        "inv": lambda: 1 / a,
        "sign": lambda: ca.sign(a),
        "not": lambda: ca.logic_not(a),
        "cube": lambda: a**3,
    }[name]()


def _two(name: str, a: ca.SX, b: ca.SX) -> ca.SX:
    return {
        "add": lambda: a + b,
        "sub": lambda: a - b,
        "mul": lambda: a * b,
        "div": lambda: a / b,
        "fmin": lambda: ca.fmin(a, b),
        "fmax": lambda: ca.fmax(a, b),
        "lt": lambda: a < b,
        "le": lambda: a <= b,
        "if": lambda: ca.if_else(a < 0, b, a),
        "and": lambda: ca.logic_and(a, b),
        "or": lambda: ca.logic_or(a, b),
    }[name]()


def random_box(
    rng: np.random.Generator, inputs: int = 3
) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper ends, from a point to some turns wide, near 0 and far."""
    scale = 10.0 ** rng.uniform(-3, 3)
    centre = scale * rng.normal(size=inputs)
    half = 10.0 ** rng.uniform(-12, 1, inputs) * (rng.random(inputs) < 0.9)
    return centre - half, centre + half
