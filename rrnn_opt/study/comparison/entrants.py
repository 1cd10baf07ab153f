"""Who is compared: every solver of QPs that installs here, and our networks."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import metadata

from rrnn_opt import networks, solving
from rrnn_opt.errors import RrnnError
from rrnn_opt.solving import Solver
from rrnn_opt.solving.conic import PLUGINS, CasadiConic
from rrnn_opt.solving.proximal import PiqpSession, ProxqpSession
from rrnn_opt.study.comparison.problem_set import ProblemSet

COLD, WARM, STREAM = "cold", "warm", "stream"

WARMED = ("osqp", "daqp", "proxqp", "qpalm", "scs", "cvxopt", "pyqpmad")
"""Back ends of qpsolvers that read ``initvals``."""

SESSIONS: dict[str, Callable[[], Solver]] = {
    "osqp": solving.OsqpSession,
    "daqp": solving.DaqpSession,
    "piqp": PiqpSession,
    "proxqp": ProxqpSession,
}

NETWORKS = ("PrimalDual", "DualNetwork", "LviPdnn", "Hildreth")
OURS = "rrnn"
"""A network of any dense QP, ``solving.dense``."""
EXACT = "active_set"
"""The exact fallback of our generated controllers."""
SMALL = 60
"""Unknowns that ours take at most: they are made for control, not for size."""

_PACKAGES = {
    "highs": "highspy",
    "proxqp": "proxsuite",
    "sip": "sip-python",
    "jaxopt_osqp": "jaxopt",
}
_METHODS = {
    "clarabel": ("interior point", "Apache-2.0"),
    "cvxopt": ("interior point", "GPL-3.0"),
    "daqp": ("active set", "MIT"),
    "ecos": ("interior point", "GPL-3.0"),
    "highs": ("active set", "MIT"),
    "jaxopt_osqp": ("ADMM", "Apache-2.0"),
    "mosek": ("interior point", "commercial"),
    "osqp": ("ADMM", "Apache-2.0"),
    "piqp": ("proximal interior point", "BSD-2-Clause"),
    "proxqp": ("augmented Lagrangian", "BSD-2-Clause"),
    "pyqpmad": ("active set", "Apache-2.0"),
    "qpalm": ("augmented Lagrangian", "LGPL-3.0"),
    "qpax": ("interior point", "MIT"),
    "qtqp": ("interior point", "Apache-2.0"),
    "quadprog": ("active set", "GPL-2.0"),
    "scs": ("ADMM", "MIT"),
    "sip": ("interior point", "MIT"),
    "qpoases": ("active set", "LGPL-2.1"),
    "qrqp": ("active set", "LGPL-3.0"),
}


@dataclass(frozen=True)
class Entrant:
    """A solver that can be asked.

    Attributes:
        name: in tables.
        method: e.g. "active set"; "" where it is not known.
        licence: its own; "" where it is not known.
        package: the distribution that it comes with.
        modes: cold, warm or stream; warm and stream are for sequences only.
        schemed: whether it needs the formulation that a set comes from.
        largest: unknowns that it takes at most.
    """

    name: str
    method: str
    licence: str
    package: str
    modes: tuple[str, ...]
    schemed: bool = False
    largest: int = 10**6

    def modes_for(self, problems: ProblemSet) -> tuple[str, ...]:
        """Modes in which it can run on a set; none where it cannot."""
        if self.schemed and problems.scheme is None:
            return ()
        if max(i.problem.q.size for i in problems.instances) > self.largest:
            return ()
        return self.modes if problems.sequence else self.modes[:1]

    def version(self) -> str:
        """Of its package, or "" where there is none."""
        try:
            return metadata.version(self.package)
        except metadata.PackageNotFoundError:
            return ""

    def make(self, mode: str, problems: ProblemSet) -> Solver:
        """The solver in one of its modes."""
        if self.name in NETWORKS:
            return _network(self.name, mode, problems)
        if self.name.startswith("casadi-"):
            return CasadiConic(self.name.removeprefix("casadi-"), mode)
        if self.name == EXACT:
            return solving.ActiveSet(mode=mode)
        if mode == STREAM:
            return SESSIONS[self.name]()
        if self.name == OURS:
            solving.register_qpsolvers(OURS)
        return solving.Qpsolvers(self.name, mode=mode)


def entrants() -> tuple[Entrant, ...]:
    """Everyone who is installed here, ours first."""
    from qpsolvers import available_solvers

    found = [_ours(name) for name in NETWORKS]
    found += [
        _small(OURS, "network", (COLD, WARM)),
        _small(EXACT, "active set", (COLD, STREAM)),
    ]
    names = sorted({*available_solvers} - {OURS})
    found += [_backend(name) for name in names]
    found += [_plugin(name) for name in PLUGINS]
    return tuple(found)


def chosen(names: Sequence[str]) -> tuple[Entrant, ...]:
    """Entrants by name; all for none.

    Raises:
        RrnnError: one is unknown or not installed.
    """
    have = {entrant.name: entrant for entrant in entrants()}
    for name in names:
        if name not in have:
            raise RrnnError(f"no solver '{name}' here; there are {', '.join(have)}")
    return tuple(have[name] for name in names) if names else tuple(have.values())


def _ours(name: str) -> Entrant:
    modes = (COLD, STREAM)
    return Entrant(name, "network", "Apache-2.0", "rrnn_opt", modes, schemed=True)


def _small(name: str, method: str, modes: tuple[str, ...]) -> Entrant:
    return Entrant(name, method, "Apache-2.0", "rrnn_opt", modes, largest=SMALL)


def _backend(name: str) -> Entrant:
    method, licence = _METHODS.get(name, ("", ""))
    modes = [COLD]
    modes += [WARM] if name in WARMED else []
    modes += [STREAM] if name in SESSIONS else []
    package = _PACKAGES.get(name, name)
    return Entrant(name, method, licence, package, tuple(modes))


def _plugin(name: str) -> Entrant:
    method, licence = _METHODS.get(name, ("", ""))
    return Entrant(f"casadi-{name}", method, licence, "casadi", (COLD, STREAM))


def _network(name: str, mode: str, problems: ProblemSet) -> Solver:
    assert problems.scheme is not None
    rule = getattr(networks, name)
    dynamics = rule()(problems.scheme())
    kept = "warm" if mode == STREAM else "cold"
    return solving.SettledNetwork(dynamics, mode=kept, tolerance=1e-7, name=name)
