"""Ground truth: every network of every scheme against solvers of QPs.

    python -m rrnn_opt.validation.studies.ground_truth \
        --points 1000 --robots pa10 panda raven2 planar3 --out DIR

For each scheme and robot seeded points are drawn (``points``); OSQP, DAQP,
ProxQP and PIQP solve them through qpsolvers with tight settings, and each
network that accepts the scheme is settled on them.  Every answer is judged by
its KKT residual, computed by us; what a solver says of itself is not read.
"""

from __future__ import annotations

import argparse
import os
import platform
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from functools import lru_cache
from importlib import metadata
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from rrnn_opt.dynamics import Dynamics
from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.robot import Kinematics, Robot
from rrnn_opt.solving import Qpsolvers
from rrnn_opt.study import Case, Results, Row, Study, processor
from rrnn_opt.validation.ending import ended
from rrnn_opt.validation.studies.block import Block
from rrnn_opt.validation.studies.catalogue import (
    network_rules,
    networks_of,
    schemes,
)
from rrnn_opt.validation.studies.documents import write
from rrnn_opt.validation.studies.infeasible import Infeasible
from rrnn_opt.validation.studies.points import Point, Points

ROBOTS = ("pa10", "panda", "raven2", "planar3")
SOLVERS = ("osqp", "daqp", "proxqp", "piqp")

REFRESH = 60.0
"""Seconds between two versions of the tables while the study runs."""


@dataclass(frozen=True)
class GroundTruth:
    """The study; one case is a block of points of one scheme on one robot.

    Attributes:
        robots: built-in robots.
        points: of each scheme on each robot.
        block: points of one case.
        schemes: names of schemes; all by default.
        networks: names of networks, with "/whiten" for whitened equality rows;
            all as they come by default.

    Raises:
        RrnnError: a scheme or network is unknown.
    """

    robots: tuple[str, ...] = ROBOTS
    points: int = 1000
    block: int = 125
    schemes: tuple[str, ...] = ()
    networks: tuple[str, ...] = ()
    name: str = "ground_truth"

    def __post_init__(self) -> None:
        _require(self.schemes, [s.name for s in schemes()], "scheme")
        _require(self.networks, list(network_rules(whitened=True)), "network")

    def __iter__(self) -> Iterator[Case]:
        """The first block of every scheme and robot, then every second one, .."""
        names = self.schemes or tuple(s.name for s in schemes())
        starts = range(0, self.points, self.block)
        for first, robot, scheme in product(starts, self.robots, names):
            count = min(self.block, self.points - first)
            given = {"robot": robot, "scheme": scheme, "count": count}
            given |= {"networks": list(self.networks)}
            yield Case(f"{robot}/{scheme}/{first}", given)

    def measure(self, case: Case, rng: np.random.Generator) -> Mapping[str, Any]:
        """Tallies of the block: of its points, of solvers, of networks."""
        robot, scheme = case.parameters["robot"], case.parameters["scheme"]
        made, refused = _networks(robot, scheme, self.networks)
        block = Block({n: Qpsolvers(n) for n in SOLVERS}, made)
        for k, point in enumerate(points_of(case, rng)):
            if point is None:
                block.points.none += 1
            else:
                block.add(f"{case.key}+{k}", point)
        _, form = _scheme(robot, scheme)
        return {
            "robot": robot,
            "scheme": scheme,
            "bounded": form.qp.bounded,
            "contacts": "clearances" in {s.name for s in form.parameters},
            "refused": refused,
            **block.row(),
        }


def points_of(case: Case, rng: np.random.Generator) -> Iterator[Point | None]:
    """The points of a case, for who wants to look at one again.

    Args:
        case: of ``GroundTruth``.
        rng: ``study.generator(case)``.
    """
    kin, form = _scheme(case.parameters["robot"], case.parameters["scheme"])
    source = Points(form, kin)
    for k in range(case.parameters["count"]):
        yield source.draw(source.kind(k), rng)


@lru_cache(maxsize=4)
def _kinematics(robot: str) -> Kinematics:
    return Kinematics(Robot.builtin(robot))


@lru_cache(maxsize=2)
def _scheme(robot: str, scheme: str) -> tuple[Kinematics, Formulation]:
    kin = _kinematics(robot)
    (found,) = (s for s in schemes() if s.name == scheme)
    return kin, found.build(kin)


@lru_cache(maxsize=2)
def _networks(
    robot: str, scheme: str, names: tuple[str, ...]
) -> tuple[dict[str, Dynamics], dict[str, str]]:
    return networks_of(_scheme(robot, scheme)[1], names)


def _require(given: Sequence[str], known: Sequence[str], what: str) -> None:
    for name in given:
        if name not in known:
            raise RrnnError(f"no {what} '{name}'; there are {', '.join(known)}")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the study, or what is left of it, and write its tables.

    Args:
        arguments: of the command line.

    Returns:
        0; 1 when a case ended in an error; 2 when a name is unknown.
    """
    given = _parser().parse_args(arguments)
    given.words = sys.argv[1:] if arguments is None else list(arguments)
    robots, names = tuple(given.robots), (tuple(given.schemes), tuple(given.networks))
    try:
        study = GroundTruth(robots, given.points, given.block, *names)
    except RrnnError as error:
        print(error, file=sys.stderr)
        return 2
    parts: tuple[Study, ...] = (
        Infeasible(robots, given.infeasible, names[1]),
        study,
    )
    with Results(given.out / "rows", seed=given.seed) as results:
        for part in () if given.finished else parts:
            _run(results, part, parts, given)
        rows = [row for part in parts for row in results.rows(part)]
    print(_write(rows, given))
    return 1 if any(row.error for row in rows) else 0


def _run(
    results: Results, part: Study, parts: Sequence[Study], given: argparse.Namespace
) -> None:
    """Run what is left of a part, refreshing the tables from time to time."""
    written = time.monotonic()
    for row in results.run(part, jobs=given.jobs):
        print(f"{row.key} {row.error}".rstrip(), file=sys.stderr, flush=True)
        if time.monotonic() - written > REFRESH:
            _write([r for each in parts for r in results.rows(each)], given)
            written = time.monotonic()


def _write(rows: Sequence[Row], given: argparse.Namespace) -> Path:
    good = [row.metrics for row in rows if not row.error]
    return write(given.out, good, title=_title(given.words, rows))


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m rrnn_opt.validation.studies.ground_truth",
        description="Compare every network of every scheme with solvers of QPs.",
    )
    add = parser.add_argument
    add("--points", type=int, default=1000, help="of each scheme and robot")
    add("--block", type=int, default=125, help="points after which tables are written")
    add("--infeasible", type=int, default=100, help="infeasible programmes a robot")
    add("--robots", nargs="+", default=ROBOTS, choices=ROBOTS)
    add("--schemes", nargs="+", default=(), help="all by default")
    add("--networks", nargs="+", default=(), help="all as they come by default")
    add("--jobs", type=int, default=1, help="worker processes")
    add("--finished", action="store_true", help="tables of what is done; run nothing")
    add("--seed", type=int, default=0)
    add("--out", type=Path, required=True, help="folder of the tables")
    return parser


def _title(words: Sequence[str], rows: Sequence[Row]) -> list[str]:
    """Command, machine, versions and date."""
    spent = sum(row.time_s for row in rows)
    known = ["numpy", "casadi", "qpsolvers", *SOLVERS[:2], "proxsuite", "piqp"]
    versions = ", ".join(f"{name} {metadata.version(name)}" for name in known)
    return [
        f"`{_parser().prog} {' '.join(words)}`",
        f"{datetime.now(UTC):%Y-%m-%d}, {spent:.0f} s in all",
        f"{processor()}, {os.cpu_count()} cores, Python {platform.python_version()}",
        versions,
    ]


if __name__ == "__main__":
    sys.exit(ended(main))
