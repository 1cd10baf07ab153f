"""Problem sets by name: what ``rrnn compare --list`` shows."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache, partial

from rrnn_opt.errors import RrnnError
from rrnn_opt.study.comparison.arms import ARMS, arm, velocity_scheme
from rrnn_opt.study.comparison.drawn import DRAWS, drawn_set
from rrnn_opt.study.comparison.motions import COUNT, MOTIONS, motion_set
from rrnn_opt.study.comparison.problem_set import SOLVABLE, ProblemSet

WINDOW = "window/pa10"

GROUPS: dict[str, tuple[str, ...]] = {
    **{kind: tuple(f"{kind}/{name}" for name in ARMS) for kind in MOTIONS},
    "window": (WINDOW,),
    "drawn": tuple(DRAWS),
    "streams": (
        *(f"{kind}/{name}" for kind in MOTIONS for name in ARMS),
        WINDOW,
    ),
    "quick": (
        "circle/pa10",
        "obstacles/panda",
        "infeasible/ur5",
        "convex",
        "contradictory",
    ),
}
GROUPS["all"] = (*GROUPS["streams"], *GROUPS["drawn"])


def set_names(study: str) -> tuple[str, ...]:
    """Names of the sets of a group, or the name itself.

    Raises:
        RrnnError: there is no such group or set.
    """
    if study in GROUPS:
        return GROUPS[study]
    if study in GROUPS["all"]:
        return (study,)
    known = ", ".join(GROUPS)
    raise RrnnError(f"no study '{study}'; there are {known}, and sets like circle/pa10")


def installed(names: Iterable[str]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Sets that can be made here, and reasons why others cannot."""
    there, reasons = [], {}
    for name in names:
        _, _, robot = name.partition("/")
        try:
            if robot:
                arm(robot)
            there.append(name)
        except RrnnError as error:
            reasons[robot] = f"{robot}: {error}"
    return tuple(there), tuple(reasons.values())


@lru_cache(maxsize=3)
def problem_set(name: str) -> ProblemSet:
    """A set by its name; the same on every machine, solvers' last digits apart.

    Raises:
        RrnnError: there is no such set.
    """
    if name == WINDOW:
        return _window()
    if name in DRAWS:
        return drawn_set(name)
    kind, _, robot = name.partition("/")
    if kind not in MOTIONS:
        raise RrnnError(f"no problem set '{name}'")
    return motion_set(kind, robot)


def _window() -> ProblemSet:
    """The QPs along a planned motion through the paper's window."""
    from rrnn_opt.motion import Trajectory
    from rrnn_opt.planning import Problem, plan
    from rrnn_opt.scene.library import scenario
    from rrnn_opt.solving import record_stream

    made = arm("pa10")
    result = plan(Problem.from_dict(scenario("window").problem(0)), seed=0)
    if result.trajectory is None:
        raise RrnnError(f"{WINDOW}: {result.message}")
    motion = Trajectory.from_dict(result.trajectory)
    form = velocity_scheme("pa10")
    stream = record_stream(form, motion, kinematics=made.kin, count=COUNT)
    return ProblemSet(
        WINDOW,
        stream.instances,
        (SOLVABLE,) * len(stream),
        True,
        f"along a motion planned through the window (pa10, {len(stream)} rows of it)",
        partial(velocity_scheme, "pa10"),
    )
