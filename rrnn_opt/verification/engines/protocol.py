"""What an engine is: a function that proposes certificates."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Protocol

from rrnn_opt.claim import Claim


class Propose(Protocol):
    """Candidate certificate documents for a claim, most promising first.

    Nothing that is yielded is believed.  An engine that can say why it has
    nothing (more) to propose raises ``UndecidedError`` with the reason.
    """

    def __call__(
        self, claim: Any, *, budget_s: float, seed: int
    ) -> Iterator[dict[str, Any]]:
        """Look for certificates for at most ``budget_s`` seconds."""
        ...


@dataclass(frozen=True)
class Engine:
    """A name and a way to find certificates.

    Attributes:
        name: what ``certify(engines=...)`` and reports call it.
        propose: the function.
        speaks_of: the kind of claim it can be asked about.
    """

    name: str
    propose: Propose
    speaks_of: type = Claim
