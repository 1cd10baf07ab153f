"""Settings of the random-RNN planner: every number has a name."""

from __future__ import annotations

from dataclasses import dataclass, field

from rrnn_opt.arguments import checked
from rrnn_opt.networks import MemoryCell


@checked()
@dataclass(frozen=True)
class RandomRnn:
    """The repaired random-RNN planner.

    Attributes:
        cell: memory cell (14) that chooses random or heuristic search.
        coin: probability of a random exploration in place of the cell, or
            None for the cell.
        max_step: largest norm of one step, rad.
        min_step: a slide stalls when no longer step can be proved, rad.
        steering_margin: clearance kept where there is room, m.
        slack: gap that every proved step keeps, m; covers rounding.
        stall_window: steps after which progress is judged.
        stall_ratio: share of the way that a window must leave at most.
        max_slide_steps: longest slide, steps.
        sweeps: Gauss-Seidel sweeps of the dual network a pass.
        sweep_least: a pass ends when a sweep moves u by no more, rad.
        rows_per_pass: most violated rows added a pass.
        passes: passes of row generation.
        node_gap: spacing of the nodes along a slide, rad.
        max_roots: most goal postures.
        ik_step: largest step of the inverse kinematics, rad.
        ik_steps: most steps of one inverse kinematics run.
        ik_share: share of the goal tolerance that it must reach.
        ik_tries: runs for the first goal posture; between thin boards one in some
            thousand is free.  After them the plan ends without a posture.
        edge: a coordinate of the random attraction is ``u^edge / 2`` of its range
            away from a limit, u uniform; 1 draws uniformly.  Attractions from
            near the limits pull a slide through more of the space.
        project: project steps on contact rows; without, a slide stops at contact.
        connect: after a random slide, slide from the other tree to its end.
        drive: let every third heuristic slide follow the tip error from the start
            tree; without, the network only finds goal postures.
        close_after: choices after which every second one steers without the margin,
            so that passages narrower than it are entered too.
        refinements: searches after the first, for a shorter path.
        shorten_slides: slides tried to shorten each path found.
    """

    cell: MemoryCell = field(default_factory=MemoryCell)
    coin: float | None = None
    max_step: float = 0.10
    min_step: float = 1e-3
    steering_margin: float = 1e-3
    slack: float = 1e-9
    stall_window: int = 12
    stall_ratio: float = 0.98
    max_slide_steps: int = 400
    sweeps: int = 10
    sweep_least: float = 0.0
    rows_per_pass: int = 8
    passes: int = 3
    node_gap: float = 0.5
    max_roots: int = 20
    ik_step: float = 0.3
    ik_steps: int = 60
    ik_share: float = 0.2
    ik_tries: int = 20_000
    edge: int = 6
    project: bool = True
    connect: bool = True
    drive: bool = True
    close_after: int = 50
    refinements: int = 3
    shorten_slides: int = 20
