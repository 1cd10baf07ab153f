"""Settings of the planners that roll the printed schemes out in time."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from rrnn_opt.arguments import checked
from rrnn_opt.networks import MemoryCell

Order = Literal["first", "second"]
Reading = Literal["transpose", "index"]
Region = Literal["ball", "posture"]
Feed = Literal["contact", "band", "failure"]


@checked()
@dataclass(frozen=True)
class PaperRnn:
    """Algorithm 1 as close to the print as it can run.

    What the print leaves open, and what is chosen here:

    * Lines 1-7 stand before the loop, which then repeats one rollout for ever;
      they are taken into the loop.
    * Line 2 draws "a random point in the task space": ``region``.
    * Line 6 takes the node whose tip is nearest to the point, as printed.  A
      node keeps posture and joint velocity, since a tip does not fix them;
      after a contact it stands still.
    * Line 7 integrates (17) with explicit Euler steps: ``order`` "second" is
      (17) itself, "first" its reduced law (18); epsilon and the step are not
      printed.
    * (10) bounds the drive with the printed c1 and c2.  (12) compares a vector
      in space with intervals of joints: ``reading``; obstacles within ``safe``
      count, each with its own set.  Of (11) only the sign has an effect, of the
      g of (13) nothing.
    * A step collides when its certificate fails; the rollout then ends where
      the last proved step left it.  Pairs of the arm's own links have no set
      (12), but end a rollout.
    * Lines 10 and 11 compare reals: ``share`` of the goal's tolerance, or
      ``random_tolerance`` at a random point.  A rollout also ends when it
      stalls or after ``max_time``.
    * Line 18 feeds the cell (14), which takes one unit of time an exploration,
      with I = 1 as ``feed`` says.  Line 19 inserts a node after every rollout
      that moved.

    Attributes:
        cell: memory cell (14).
        coin: probability of a random exploration in place of the cell, or None.
        order: of the network.
        reading: of (12), as in ``formulations.joint_sign_sets``.
        region: "ball", uniform in the ball that the tip cannot leave, or
            "posture", the tip of a uniform posture.
        feed: "contact", a step could not be proved free; "band", an obstacle
            came within ``safe``; "failure", the target was not reached.
        epsilon: of (17), s.
        c1: of (10), 1/s.
        c2: of (10), 1/s.
        step: of the integration, s.
        safe: clearance at and below which (12) holds, m.
        share: share of the goal's tolerance that the tip must reach.
        random_tolerance: m.
        stall_time: s after which the error is judged.
        stall_ratio: share of the error that must be left at most.
        max_time: of one rollout, s.
    """

    cell: MemoryCell = field(default_factory=MemoryCell)
    coin: float | None = None
    order: Order = "second"
    reading: Reading = "transpose"
    region: Region = "ball"
    feed: Feed = "contact"
    epsilon: float = 0.01
    c1: float = 0.5
    c2: float = 0.5
    step: float = 0.002
    safe: float = 0.005
    share: float = 0.9
    random_tolerance: float = 0.01
    stall_time: float = 0.25
    stall_ratio: float = 0.98
    max_time: float = 10.0


@checked()
@dataclass(frozen=True)
class SingleRollout:
    """One heuristic rollout of a comparison scheme: a stand-in, not a replica.

    The schemes are the reconstructions ``formulations.method1`` (velocity) and
    ``formulations.method2`` (acceleration): smallest norm subject to the task
    row, the sign rows of contacts and limits.  The task is an attraction
    straight to the goal,

        v = e min(gain, speed / |e|),    level "velocity": J u = v,
        level "acceleration":  J u = rate (v - J qd) - J' qd,

    so that position errors do not pile up, in favour of the schemes.  Each
    programme is solved by ``sweeps`` sweeps of its dual network; where it has no
    solution the unfinished iterate is taken, within its bounds.

    Attributes:
        level: of the scheme.
        gain: of the attraction, 1/s.
        speed: largest speed of the tip, m/s.
        rate: of the velocity loop, 1/s.
        inner: clearance at which sign rows allow no approach, m.
        outer: clearance at which they set in, m.
        contacts: nearest obstacle pairs that get rows.
        kappa_o: rate of the acceleration-level rows, 1/s.
        sweeps: of the dual network, a step.
        step: of the integration, s.
        c1: of (10), 1/s.
        c2: of (10), 1/s.
        share: share of the goal's tolerance that the tip must reach.
        stall_time: s after which the error is judged.
        stall_ratio: share of the error that must be left at most.
        max_time: of the rollout, s.
        cell: unused by the rollout; names the compiled runtime.
    """

    level: Literal["velocity", "acceleration"] = "velocity"
    gain: float = 5.0
    speed: float = 0.25
    rate: float = 20.0
    inner: float = 0.002
    outer: float = 0.02
    contacts: int = 10
    kappa_o: float = 10.0
    sweeps: int = 60
    step: float = 0.005
    c1: float = 0.5
    c2: float = 0.5
    share: float = 0.9
    stall_time: float = 0.5
    stall_ratio: float = 0.98
    max_time: float = 20.0
    cell: MemoryCell = field(default_factory=MemoryCell)


RolloutSettings = PaperRnn | SingleRollout
