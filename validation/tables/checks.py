"""Checks behind the columns of Table I: each runs something, and says what it saw.

A check returns a verdict ("Yes" or "No", "Zero" or "Nonzero") and one sentence.
All are on the PA10, with control periods of 10 ms.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from rrnn_opt.networks.inspection import graph_operations
from rrnn_opt.simulation import Control, Curve, SimulationResult, Task, simulate
from rrnn_opt.simulation.task import Array
from rrnn_opt.validation.tables.arm import arm
from rrnn_opt.validation.tables.blocked import blocked
from rrnn_opt.validation.tables.models import FromAnywhere, Model
from rrnn_opt.validation.tables.tracking import CIRCLES, task

Finding = tuple[str, str]

REACHED = 1e-3
"""Error at which a target counts as reached, m."""

AT_STOP = 1e-3
"""Distance at which a joint counts as at its stop, rad."""

GROWTH = 2.0
"""Ratio of mean squares, last round over first, beyond which errors accumulate."""

EXACT = 1e-5
"""Error that counts as none, m."""

STEPS = 2000
"""Network steps a period, at most, where programmes without a solution occur."""

INVERTING = frozenset({"div", "inv", "sqrt", "pow"})
"""Operations that a product, a sum or a projection never needs."""


def yes(holds: bool) -> str:
    """The paper's words."""
    return "Yes" if holds else "No"


def postures(count: int, seed: int) -> Iterator[tuple[Array, Array]]:
    """Random starts, and random targets of the tip that the arm can reach."""
    robot, kin = arm()
    low = np.where(np.isfinite(robot.limits.lower), robot.limits.lower, -np.pi)
    high = np.where(np.isfinite(robot.limits.upper), robot.limits.upper, np.pi)
    rng, edge = np.random.default_rng([seed, 2]), 0.02 * (high - low)
    position = kin.functions()["position"]
    for _ in range(count):
        q0, q1 = rng.uniform(low + edge, high - edge, (2, robot.nv))
        yield q0, np.asarray(position(q1), dtype=np.float64).ravel()


def run(model: Model, what: Task, **options: object) -> SimulationResult:
    """One run of a row on the arm."""
    rule = options.get("network", model.network)
    return simulate(model.scheme, arm()[0], what, network=rule)  # type: ignore[arg-type]


def global_convergence(model: Model, *, runs: int = 4) -> Finding:
    """Network to the optimum from random states; tip to fixed targets from anywhere.

    The second part is asked of rows that measure the position.
    """
    circle, unsettled = next(iter(CIRCLES)), 0
    for seed in range(runs):
        rule = FromAnywhere(model.network, seed)
        curve = replace(task(circle, 0.0, 0).curve, duration=0.5)
        what = replace(task(circle, 0.0, 0), curve=curve)
        unsettled += run(model, what, network=rule).record.unsettled
    words = (
        "the network came to rest from every random state"
        if unsettled == 0
        else f"the network did not come to rest in {unsettled} periods"
    )
    if "rd" not in {p.name for p in model.form(arm()[1]).parameters}:
        text = f"{words}; the position is not measured, so no first error is removed"
        return yes(unsettled == 0), text
    ends = [_end(model, q0, rd) for q0, rd in postures(runs, 5)]
    reached = sum(error < REACHED for error, _ in ends)
    stopped = sum(error >= REACHED and stop for error, stop in ends)
    text = f"{words}; the tip reached {reached} of {runs} reachable fixed targets"
    if reached < runs:
        text += f"; of the others, with a joint at a stop or beyond: {stopped}"
    return yes(unsettled == 0 and reached == runs), text


def _end(model: Model, q0: Array, rd: Array) -> tuple[float, bool]:
    """Last error, m, and whether a joint is at a stop, of 30 s towards a target."""
    what = Task(
        curve=Curve("point", 30.0, 30.0, position=rd),
        q0=q0,
        control=Control(law=model.law, steps=None if _literal(model) else STEPS),
    )
    result, limits = run(model, what), arm()[0].limits
    room = np.minimum(limits.upper - result.q[-1], result.q[-1] - limits.lower)
    return float(np.linalg.norm(result.error[-1])), bool((room < AT_STOP).any())


def theoretical_error(model: Model) -> Finding:
    """Error on a circle without noise, in the limit of short control periods.

    With a + b dt for the error, a = (4 e(dt / 4) - e(dt)) / 3.
    """
    coarse, fine = (_circle_error(model, dt) for dt in (0.01, 0.0025))
    limit = abs(4.0 * fine - coarse) / 3.0
    text = f"{1e3 * coarse:.3g} mm at 10 ms, {1e3 * fine:.3g} mm at 2.5 ms"
    if limit < EXACT:
        return "Zero", f"{text}: none is left as the period goes to zero"
    return "Nonzero", f"{text}: {1e3 * limit:.3g} mm stay behind a moving target"


def _circle_error(model: Model, dt: float) -> float:
    what = task(next(iter(CIRCLES)), 0.0, 0, law=model.law)
    return run(model, replace(what, control=replace(what.control, dt=dt))).rms_error_m


def no_accumulation(model: Model, *, seeds: int = 3) -> Finding:
    """Mean square error of the fourth round under noise over that of the first."""
    squares = np.zeros(2)
    for seed in range(seeds):
        what = task(next(iter(CIRCLES)), 0.05, seed, law=model.law)
        curve = replace(what.curve, duration=40.0)
        length = np.sum(run(model, replace(what, curve=curve)).error ** 2, axis=1)
        squares += [np.mean(length[:1000]), np.mean(length[-1000:])]
    ratio = float(squares[1] / squares[0])
    first, last = (1e3 * np.sqrt(squares / seeds)).tolist()
    text = f"sigma = 0.05 rad/s: {first:.2f} mm in the first round, {last:.2f} mm"
    return yes(ratio < GROWTH), text + " in the fourth"


def no_inversion(model: Model) -> Finding:
    """Operations in the graph of scheme and network, and what both declare."""
    form = model.form(arm()[1], (42,))
    found = graph_operations(model.network(form)) & INVERTING
    needs = model.network.needs(form).inverse
    free = not found and needs == "none" and not form.inverse
    if free:
        return "Yes", "products, sums and projections only"
    holds = ", ".join(sorted(found))
    return "No", f"the graph holds {holds}: {form.inverse or needs}"


def physical_limits(model: Model, *, runs: int = 6) -> Finding:
    """Limits in fast motions from random starts to random targets."""
    kept, stuck = 0, 0
    for q0, rd in postures(runs, 6):
        control = Control(law=model.law, steps=None if _literal(model) else STEPS)
        curve = Curve("line", 4.0, 6.0, position=rd)
        result = run(model, Task(curve=curve, q0=q0, control=control))
        kept += result.limits_kept
        stuck += result.record.unsettled > 0
    text = f"kept in {kept} of {runs} fast motions from random starts"
    if stuck:
        text += f"; in {stuck} of them the network found no rest in some periods"
    return yes(kept == runs), text


def _literal(model: Model) -> bool:
    return model.law == "literal"


def smoothness(model: Model) -> Finding:
    """Peak joint acceleration at events, as the control period shrinks.

    The events are a start off target and, where the scheme has contacts, an
    obstacle that comes near.  A scheme whose velocity jumps at one has a peak
    that grows like one over the period.
    """
    coarse, fine = (_peaks(model, dt) for dt in (0.01, 0.0025))
    jumps = [name for name in coarse if fine[name] > 2.0 * coarse[name]]
    text = "; ".join(
        f"{name}: peak joint acceleration {coarse[name]:.3g} rad/s2 at 10 ms, "
        f"{fine[name]:.3g} at 2.5 ms"
        for name in coarse
    )
    return yes(not jumps), text + ": the velocity jumps" * bool(jumps)


def _peaks(model: Model, dt: float) -> dict[str, float]:
    """Largest acceleration of the velocity without noise, by event."""
    events = {"start off target": (model.scheme, _off_target())}
    if model.avoids:
        found = blocked(model, 1)[0]
        events["obstacle"] = (model.told(found.contacts), found.task)
    peaks = {}
    for name, (scheme, what) in events.items():
        what = replace(what, control=Control(dt=dt, steps=STEPS))
        rule = model.network
        velocity = simulate(scheme, arm()[0], what, network=rule).record.velocity
        change = np.abs(np.diff(velocity, axis=0, prepend=0.0))
        peaks[name] = float(change.max() / dt)
    return peaks


def _off_target() -> Task:
    """The first second of a circle, begun at rest 5 cm beside it."""
    what = task(next(iter(CIRCLES)), 0.0, 0)
    tip = np.asarray(arm()[1].functions()["position"](what.q0)).ravel()
    off = tip + np.array([0.0, 0.15, 0.05])
    return replace(what, curve=replace(what.curve, centre=off, duration=1.0))
