"""From waypoints to a trajectory that is proved as delivered."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Generic, NamedTuple, Protocol, TypeVar

from numpy.typing import ArrayLike

from rrnn_opt.errors import RetimeError
from rrnn_opt.motion.retime import retime
from rrnn_opt.motion.stop_and_go import stop_and_go
from rrnn_opt.motion.trajectory import Trajectory

if TYPE_CHECKING:
    from rrnn_opt.robot import Limits

SPACINGS = (0.1, 0.05, 0.025, 0.0125, 0.006, 0.003)
SPLINE, STOP_AND_GO = "spline", "stop_and_go"
PROVED = "PROVED"


class Certificate(Protocol):
    """What a certifier must say: "PROVED", "REFUTED" or "UNKNOWN" of both."""

    @property
    def collision_free(self) -> str:
        """Verdict on collisions."""

    @property
    def limits(self) -> str:
        """Verdict on joint limits."""


C = TypeVar("C", bound=Certificate)


@dataclass(frozen=True)
class Attempt:
    """One try of the delivery loop.

    Attributes:
        kind: "spline" or "stop_and_go".
        spacing: knot distance, rad; None for stop_and_go.
        collision_free: verdict, or "" when there was no trajectory.
        limits: likewise.
        duration: of the trajectory, s, or None.
        reason: why there was no trajectory, or "".
        time_s: retiming and certificate, s.
    """

    kind: str
    spacing: float | None
    collision_free: str = ""
    limits: str = ""
    duration: float | None = None
    reason: str = ""
    time_s: float = 0.0

    @property
    def proved(self) -> bool:
        """Both verdicts are PROVED."""
        return self.collision_free == PROVED and self.limits == PROVED


class Delivery(NamedTuple, Generic[C]):
    """A trajectory, its certificate, and all that was tried, in order."""

    trajectory: Trajectory
    certificate: C
    attempts: tuple[Attempt, ...]


def deliver(
    waypoints: ArrayLike,
    limits: Limits,
    certify: Callable[[Trajectory], C],
    *,
    spacings: Sequence[float] = SPACINGS,
) -> Delivery[C]:
    """Time a path so that the trajectory itself is proved, not its waypoints.

    Smooth and retime at each spacing in turn; the first trajectory that the
    certifier proves is delivered.  If none is, the polyline is followed itself,
    at rest at every corner (:func:`stop_and_go`): slower, but what was proved
    of the straight lines carries over.

    Args:
        waypoints: (N, nv), rad or m.
        limits: joint limits.
        certify: judges a trajectory as delivered.
        spacings: knot distances to try, coarse to fine, rad or m.

    Returns:
        The first proved trajectory; without one the last, with its verdict.

    Raises:
        NotFiniteError, ShapeError, RetimeError: malformed input.
    """
    attempts: list[Attempt] = []
    for spacing in spacings:
        begin = time.perf_counter()
        try:
            trajectory = retime(waypoints, limits, spacing=spacing)
        except RetimeError as error:
            spent = time.perf_counter() - begin
            attempts.append(Attempt(SPLINE, spacing, reason=str(error), time_s=spent))
            continue
        certificate, attempt = _judged(trajectory, certify, spacing, begin)
        attempts.append(attempt)
        if attempt.proved:
            return Delivery(trajectory, certificate, tuple(attempts))
    begin = time.perf_counter()
    trajectory = stop_and_go(waypoints, limits)
    certificate, attempt = _judged(trajectory, certify, None, begin)
    return Delivery(trajectory, certificate, (*attempts, attempt))


def _judged(
    trajectory: Trajectory,
    certify: Callable[[Trajectory], C],
    spacing: float | None,
    begin: float,
) -> tuple[C, Attempt]:
    certificate = certify(trajectory)
    return certificate, Attempt(
        STOP_AND_GO if spacing is None else SPLINE,
        spacing,
        certificate.collision_free,
        certificate.limits,
        trajectory.duration,
        time_s=time.perf_counter() - begin,
    )
