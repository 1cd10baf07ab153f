"""Circle tracking under white noise: the tasks and schemes of Table II and Figure 3.

The paper gives neither where the noise enters nor its unit, nor the step, the
circles, the start or the gains of the other schemes.  Ours, for all rows alike:

* PA10; three circles of radius 0.15 m, once round in 10 s, starting and
  ending at rest (phi = 2 pi sin^2(pi t / 2T)); starts in ``CIRCLES``; the arm
  starts at rest and on the circle;
* a control period of 10 ms; limits (10) with c1 = c2 = 0.5 1/s where a scheme
  has limits;
* white Gaussian noise, independent for each joint, added to the joint velocity
  that is done, rad/s; one draw a period, held for it; no scheme is told of it;
* the network comes to rest in every period, except for (17) as printed, which
  runs in time, with ten steps in the time of its settling step.

The error is the root mean square of the tip's distance from its reference
over the samples of one run, in metres.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import lru_cache, partial

import numpy as np

from rrnn_opt.dynamics import NeuralDynamics
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations import (
    classical,
    closed_loop,
    method1,
    method2,
    method3,
    minimum_velocity,
    position_feedback,
    quiet_posture,
)
from rrnn_opt.networks import DualNetwork, PrimalDual
from rrnn_opt.robot import Robot
from rrnn_opt.simulation import Control, Curve, Noise, SimulationResult, Task, simulate
from rrnn_opt.validation.tables.printed import printed_row, rows_of

SIGMAS = (0.01, 0.05, 0.25)
CIRCLES: dict[str, tuple[tuple[float, ...], str]] = {
    "A": ((0.0, 30.0, 0.0, 60.0, 0.0, 45.0, 0.0), "yz"),
    "B": ((0.0, -45.0, 0.0, 90.0, 0.0, -45.0, 0.0), "xy"),
    "C": ((20.0, 20.0, 30.0, 90.0, 0.0, 40.0, 0.0), "yz"),
}
"""Start in degrees, and the plane; the centre lies 0.15 m along its first axis."""

_FAST = DualNetwork(whiten=True)
_SLOW = PrimalDual(epsilon=0.01)
_BOXED = PrimalDual(epsilon=0.01, whiten=True)
"""Its output obeys the bounds even where the rows contradict them."""


@dataclass(frozen=True, eq=False)
class Entry:
    """One row.

    Attributes:
        label: of the row.
        scheme: function of the kinematics.
        kind: "paper": the scheme that the paper proposes, as it can be read;
            "ours": what we make of it; "rival": what both are compared with.
        paper: the paper's numbers, m, by sigma; none where it has no such row.
        fixed: settings that stay.
        ranges: gains that are searched, with least and largest value.
        law: "reduced" or "literal".
        network: that settles it.
        steps: of the network in a period, at most; None for the usual number.
        note: what a reader must know.
    """

    label: str
    scheme: Callable[..., Formulation]
    kind: str
    paper: tuple[float, ...] = ()
    fixed: Mapping[str, float | bool] = field(default_factory=dict)
    ranges: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    law: str = "reduced"
    network: Callable[[Formulation], NeuralDynamics] = _FAST
    steps: int | None = None
    note: str = ""

    def with_gains(self, gains: Mapping[str, float]) -> Callable[..., Formulation]:
        """The scheme with these gains."""
        return partial(self.scheme, **{**self.fixed, **gains})


_PROPOSED, _ONE, _TWO, _THREE = (printed_row("II", row) for row in rows_of("II"))
_RATE = (1.0, 100.0)
"""Of a feedback, 1/s: up to one over the control period."""

ENTRIES: dict[str, Entry] = {
    "proposed": Entry(
        "proposed, (17) as printed",
        position_feedback,
        "paper",
        _PROPOSED,
        {"epsilon": 0.01},
        law="literal",
        network=_SLOW,
        note="k = 1/epsilon = 100 as in the paper; no feed-forward, hence a lag",
    ),
    "reduced": Entry(
        "proposed, reduced law (18)",
        position_feedback,
        "paper",
        _PROPOSED,
        ranges={"epsilon": (0.004, 0.1)},
        network=_SLOW,
        note="the first-order law of the paper's proof, with its gain searched",
    ),
    "forward": Entry(
        "proposed, with feed-forward",
        position_feedback,
        "ours",
        _PROPOSED,
        {"feed_forward": True},
        {"epsilon": (0.004, 0.1)},
        network=_SLOW,
        note="rd_dot is told, so nothing lags",
    ),
    "closed_loop": Entry(
        "feedback in the constraint",
        closed_loop,
        "ours",
        _PROPOSED,
        ranges={"kappa": _RATE},
        network=_BOXED,
        steps=2000,
        note="all directions of the error decay alike",
    ),
    "quiet": Entry(
        "the same, quiet posture",
        quiet_posture,
        "ours",
        _PROPOSED,
        ranges={"kappa": _RATE, "gain": (0.5, 50.0)},
        network=_BOXED,
        steps=2000,
        note="self-motion to postures at which joint noise moves the tip least",
    ),
    "method1": Entry(
        "Method 1 [25]",
        method1,
        "rival",
        _ONE,
        ranges={"c1": (0.2, 4.0), "c2": (0.2, 4.0)},
        note="open loop: its only gains are those of the limits",
    ),
    "method2": Entry(
        "Method 2 [26]",
        method2,
        "rival",
        _TWO,
        ranges={"mu_p": (2.0, 200.0), "mu_v": (2.0, 200.0)},
        note="open loop at the acceleration level: gains of the limits only",
    ),
    "method3": Entry(
        "Method 3 [44], stand-in",
        method3,
        "rival",
        _THREE,
        ranges={"k0": _RATE, "k1": (10.0, 10_000.0)},
        note="proportional and integral feedback",
    ),
    "classical": Entry(
        "classical (15)-(16)",
        classical,
        "rival",
        network=_SLOW,
        note="the multiplier integrates what was commanded: open loop; once the "
        "network is at rest epsilon plays no part",
    ),
    "open": Entry(
        "minimum velocity, open loop", minimum_velocity, "rival", note="no gains"
    ),
}


@lru_cache(maxsize=1)
def robot() -> Robot:
    """The arm of the study."""
    return Robot.builtin("pa10")


def task(
    circle: str,
    sigma: float,
    seed: int,
    *,
    law: str = "reduced",
    steps: int | None = None,
) -> Task:
    """One run's task.

    Args:
        circle: of ``CIRCLES``.
        sigma: of the noise, rad/s.
        seed: of the noise.
        law: how the network runs.
        steps: of the network in a period, at most.
    """
    start, plane = CIRCLES[circle]
    return Task(
        curve=Curve("circle", 10.0, 10.0, plane=plane, radius=0.15),
        q0=np.deg2rad(np.array(start)),
        control=Control(dt=0.01, epsilon=0.01, law=law, steps=steps),
        noise=Noise("joint_velocity", sigma, seed),
    )


class Runner:
    """Runs of one row with fixed gains: the loop is compiled once.

    Args:
        entry: the row.
        gains: its gains.
    """

    def __init__(self, entry: Entry, gains: Mapping[str, float]) -> None:
        self._entry = entry
        self._scheme = entry.with_gains(gains)

    def run(self, circle: str, sigma: float, seed: int) -> SimulationResult:
        """One run; see ``task``."""
        entry = self._entry
        what = task(circle, sigma, seed, law=entry.law, steps=entry.steps)
        return simulate(self._scheme, robot(), what, network=entry.network)
