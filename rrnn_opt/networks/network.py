"""What every network offers: a rule with hyper-parameters only, and what it needs."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass

from numpy.typing import ArrayLike

from rrnn_opt.dynamics import DiscreteDynamics, NeuralDynamics
from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation

NONE = "none"
"""No inverse: products, sums, projections, and division by numbers only."""

CONSTANT = "constant P inverse"
"""The inverse of the constant Hessian, computed once when the network is made."""

CHOLESKY = "Cholesky of A A'"
"""A small factorisation in every step, of the equality rows."""

KKT = "KKT solve"
"""A linear solve with the KKT matrix in every step."""

ARITHMETIC = frozenset({"add", "sub", "mul", "neg", "twice", "scale"})
"""Tape operations of products and sums; "scale" divides by a constant number."""

CLIPPING = frozenset({"fmin", "fmax"})
"""Tape operations of a projection on a box."""


@dataclass(frozen=True)
class Needs:
    """What a network needs for one formulation.

    Attributes:
        inverse: matrix inverse or factorisation that its graph holds: "none",
            or one or two of the other three names above, joined by " and ".
        duals: dual neurons.
        state: neurons in all.
        definite: whether a positive definite Hessian is needed for it to be
            promised to converge.
        rates: whether it is told the time derivatives of the data.
    """

    inverse: str
    duals: int
    state: int
    definite: bool
    rates: bool = False


class Network(ABC):
    """A rule that makes dynamics from a formulation.

    Implementations are frozen dataclasses of hyper-parameters.  One refuses a
    formulation that it cannot solve with an RrnnError that names what is in
    the way.
    """

    @abstractmethod
    def __call__(self, form: Formulation) -> NeuralDynamics | DiscreteDynamics:
        """The network of ``form``: ``x' = f(x, parameters)``, or ``x+ = g(x, ..)``."""

    @abstractmethod
    def needs(self, form: Formulation) -> Needs:
        """What the network of ``form`` needs.

        Args:
            form: the formulation it would be made of.
        """

    @property
    @abstractmethod
    def operations(self) -> frozenset[str]:
        """Tape operations that the network adds to those of the formulation.

        "scale" is a division by a constant number; a "div" divides by data.
        """

    @abstractmethod
    def euler_bound(self, form: Formulation, **parameters: ArrayLike) -> float:
        """Longest Euler step, s, that every mode survives; what holds it, see there.

        Args:
            form: what the network is made from.
            **parameters: one array a parameter of the formulation.

        Returns:
            The bound, s; infinite for a map, 0 where none is promised.
        """


def require_positive(who: str, **numbers: float) -> None:
    """Refuse hyper-parameters that are not positive and finite.

    Raises:
        RrnnError: one is not.
    """
    for name, value in numbers.items():
        if not 0.0 < value < math.inf:
            raise RrnnError(f"{who}: {name} {value}: it must be positive and finite")


def rows(form: Formulation) -> int:
    """Equality and inequality rows of a formulation."""
    return int(form.equalities.size1() + form.inequalities.size1())
