"""What networks that project have in common: whitening on request, and needs."""

from __future__ import annotations

import math
from abc import abstractmethod
from dataclasses import dataclass, fields
from typing import ClassVar, Generic

from numpy.typing import ArrayLike

from rrnn_opt.arguments import checked
from rrnn_opt.dynamics import DiscreteDynamics
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks import whitening
from rrnn_opt.networks.network import (
    ARITHMETIC,
    CLIPPING,
    Needs,
    Network,
    require_positive,
    rows,
)
from rrnn_opt.networks.whitening import D


@dataclass(frozen=True, kw_only=True)
class ProjectionNetwork(Network, Generic[D]):
    """A network over y = (u, lambda, mu) whose equality rows may be whitened.

    Attributes:
        whiten: whether the equality rows are whitened; see ``whitening``.
        delta: of the whitening.

    Raises:
        RrnnError: a number is not positive and finite.
    """

    definite: ClassVar[bool] = False
    """Whether it is promised to converge for a positive definite Hessian only."""

    extra: ClassVar[frozenset[str]] = frozenset()
    """Tape operations beyond products, sums and projections."""

    whiten: bool = False
    delta: float = 1e-6

    def __post_init__(self) -> None:
        """Refuse numbers that are not positive and finite."""
        numbers = {f.name: getattr(self, f.name) for f in fields(self)}
        del numbers["whiten"]
        require_positive(type(self).__name__, **numbers)

    @checked()
    def __call__(self, form: Formulation) -> D:
        """The network of ``form``.

        Args:
            form: any formulation that the network can solve.

        Returns:
            Its dynamics, with the decision as output and the multipliers of
            the rows as declared.

        Raises:
            RrnnError: the network cannot solve the formulation.
        """
        if self.whiten:
            return whitening.whitened(self._made, form, self.delta)
        return self._made(form)

    def needs(self, form: Formulation) -> Needs:
        """No inverse unless whitened."""
        return Needs(
            inverse=whitening.inverse_of(form, whiten=self.whiten),
            duals=rows(form),
            state=form.decision.size + rows(form),
            definite=self.definite,
        )

    @property
    def operations(self) -> frozenset[str]:
        """Products, sums, projections, ``extra``; a factorisation when whitened."""
        factor = whitening.OPERATIONS if self.whiten else frozenset()
        return ARITHMETIC | CLIPPING | self.extra | factor

    def conditioned(self, form: Formulation) -> Formulation:
        """The formulation that the network works on: whitened on request."""
        return whitening.Whitened.of(form, self.delta).form if self.whiten else form

    @abstractmethod
    def _made(self, form: Formulation) -> D:
        """The dynamics for rows that are taken as they are."""


@dataclass(frozen=True, kw_only=True)
class ProjectionMap(ProjectionNetwork[DiscreteDynamics]):
    """A projection network that is an iteration: it has no step size."""

    def euler_bound(self, form: Formulation, **parameters: ArrayLike) -> float:
        """Infinite: a map has no step size."""
        return math.inf
