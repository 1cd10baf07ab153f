"""An equality-constrained programme whose data move, for zeroing networks."""

import numpy as np

from tests.networks.toy import LINEAR, WEIGHT, law, point, programme


def equations():
    return programme(inequalities=False, bounds=False)


def moved(given, rates, t):
    return {name: given[name] + t * rates[name] for name in given}


def rates_of(seed):
    rng = np.random.default_rng(seed + 100)
    return {"A": rng.normal(size=(2, 4)), "b": rng.normal(size=2)}


def told(given, rates):
    return given | {f"{name}_rate": value for name, value in rates.items()}


def matrix(given):
    A = given["A"]
    return np.block([[WEIGHT, -A.T], [A, np.zeros((2, 2))]])


def error(given, y):
    """``(W u + c - A' lambda, A u - b)``."""
    return matrix(given) @ y[:6] + np.concatenate([LINEAR, -given["b"]])


def error_rate(dynamics, seed, state):
    """Central difference of the error along the network and the moving data."""
    given, rates = point(seed), rates_of(seed)
    slope, h = law(dynamics, state, told(given, rates)), 1e-6
    ahead = error(moved(given, rates, h), state + h * slope)
    behind = error(moved(given, rates, -h), state - h * slope)
    return (ahead - behind) / (2 * h), error(given, state)
