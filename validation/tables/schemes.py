"""Every scheme and every network on one task, in numbers that help to choose.

    python -m rrnn_opt.validation.tables.schemes --out DIR

The task is circle A of ``tracking`` on the PA10; networks are run on
``closed_loop`` (equality rows and bounds), schemes with a whitened dual network.
"""

from __future__ import annotations

import argparse
import inspect
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, cast

import numpy as np

from rrnn_opt import formulations, networks
from rrnn_opt.errors import RrnnError
from rrnn_opt.formulations import closed_loop
from rrnn_opt.networks import DualNetwork
from rrnn_opt.report import write_text
from rrnn_opt.simulation import SimulationResult, Task, simulate
from rrnn_opt.validation.ending import ended
from rrnn_opt.validation.tables.arm import arm
from rrnn_opt.validation.tables.cell import markdown
from rrnn_opt.validation.tables.page import head, spelled
from rrnn_opt.validation.tables.tracking import task

PROGRAM = "python -m rrnn_opt.validation.tables.schemes"
_SEEDS = 3

MOST = 500
"""Network steps a period, at most."""


_USUAL = DualNetwork(whiten=True)


def _task(sigma: float, seed: int) -> Task:
    what = task("A", sigma, seed)
    return replace(what, control=replace(what.control, steps=MOST))


def scheme_names() -> list[str]:
    """Schemes that ``rrnn_opt.formulations`` exports."""
    return [
        name
        for name in formulations.__all__
        if "Formulation" in str(inspect.signature(getattr(formulations, name)))
    ]


def rules() -> dict[str, Any]:
    """Networks that ``rrnn_opt.networks`` exports, and whitened ones."""
    found: dict[str, Any] = {}
    for name in networks.__all__:
        rule: Any = getattr(networks, name)
        if not (inspect.isclass(rule) and issubclass(rule, networks.Network)):
            continue
        if rule is networks.Network:
            continue
        found[name] = rule()
        if "whiten" in inspect.signature(rule).parameters:
            found[f"{name}(whiten=True)"] = cast(Any, rule)(whiten=True)
    return found


def scheme_row(name: str) -> list[str]:
    """Errors, speeds and drift of one scheme."""
    quiet = simulate(name, arm()[0], _task(0.0, 0), network=_USUAL)
    noisy = [
        simulate(name, arm()[0], _task(0.05, seed), network=_USUAL)
        for seed in range(_SEEDS)
    ]
    drift = np.linalg.norm(quiet.q[-1] - quiet.q[0])
    rest = 1.0 - quiet.record.unsettled / len(quiet.t)
    return [
        f"`{name}`",
        quiet.level,
        f"{1e3 * quiet.rms_error_m:.3g}",
        f"{1e3 * np.mean([r.rms_error_m for r in noisy]):.3g}",
        f"{np.abs(quiet.record.velocity).max():.3f}",
        f"{drift:.3f}",
        f"{100 * rest:.1f} %",
    ]


def network_row(name: str, rule: Any) -> list[str]:
    """Steps, time and what a network needs; or why it refuses."""
    scheme: Any = closed_loop
    try:
        needs = rule.needs(closed_loop(arm()[1]))
        run, seconds = _timed(scheme, _task(0.05, 0), rule)
    except RrnnError as error:
        free = _without_bounds
        try:
            needs = rule.needs(free(arm()[1]))
            run, seconds = _timed(free, _task(0.05, 0), rule)
        except RrnnError:
            return [f"`{name}`", "-", "-", "-", "-", str(error).split(":")[-1].strip()]
        scheme = free
    periods = len(run.t)
    return [
        f"`{name}`",
        f"{run.record.network_steps / periods:.1f}",
        f"{1e6 * seconds / periods:.2f}",
        f"{100 * (1 - run.record.unsettled / periods):.1f} %",
        needs.inverse,
        "without the bounds, which it refuses" if scheme is not closed_loop else "",
    ]


def _without_bounds(kin: Any) -> Any:
    return replace(closed_loop(kin), lower=None, upper=None)


def _timed(scheme: Any, what: Task, rule: Any) -> tuple[SimulationResult, float]:
    """A run, and the lesser of two warm times of it, s, with all of Python's share."""
    times = []
    for _ in range(3):
        begin = time.perf_counter()
        run = simulate(scheme, arm()[0], what, network=rule)
        times.append(time.perf_counter() - begin)
    return run, min(times[1:])


def sections() -> Iterator[str]:
    """The page's tables."""
    header = ["scheme", "commands", "error [mm]", "sigma 0.05 [mm]"]
    header += ["fastest joint [rad/s]", "drift [rad]", "at rest"]
    yield (
        "## Schemes\n\nRoot mean square error without noise and, over "
        f"{_SEEDS} seeds, with noise of 0.05 rad/s on the joint velocities; fastest "
        "joint; distance of the joints from their start after the round; share of the "
        f"periods in which `DualNetwork(whiten=True)` was at rest after {MOST} steps. "
        " Gains as they come."
    )
    yield markdown(header, [scheme_row(name) for name in scheme_names()])
    header = ["network", "steps a period", "us a period", "at rest", "inverse", "note"]
    yield (
        "## Networks\n\nOn `closed_loop` with noise of 0.05 rad/s: steps until the "
        "residual is 1e-9, from the last period's state; time of a period with all "
        "that is in it; settings as they come."
    )
    yield markdown(header, [network_row(*pair) for pair in rules().items()])


def main(arguments: Sequence[str] | None = None) -> int:
    """Run, print the page and write ``schemes.md``.

    Args:
        arguments: of the command line.
    """
    parser = argparse.ArgumentParser(prog=PROGRAM, description="Schemes, networks.")
    parser.add_argument("--out", type=Path, help="folder of schemes.md")
    given = parser.parse_args(arguments)
    words = sys.argv[1:] if arguments is None else list(arguments)
    title = "Schemes and networks on one task"
    text = "\n\n".join([head(title, spelled(PROGRAM, words)), *sections()]) + "\n"
    print(text)
    if given.out is not None:
        given.out.mkdir(parents=True, exist_ok=True)
        write_text(given.out / "schemes.md", text)
    return 0


if __name__ == "__main__":
    sys.exit(ended(main))
