"""``rrnn plan``: a problem file in, a certified trajectory out."""

from __future__ import annotations

import argparse
import sys
from typing import Any

from rrnn_opt.cli.arguments import count, seconds, seed
from rrnn_opt.cli.folders import folder
from rrnn_opt.cli.output import Output

HELP = "plan a motion, retime it and prove it"
PLANNER = "random-rnn"
EXPLORATIONS = 20_000
STATUS = {"bad_input": "invalid_problem", "interrupted": "interrupted"}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's arguments."""
    parser.add_argument("problem", metavar="PROBLEM.json", help="the problem file")
    parser.add_argument(
        "--planner", default=PLANNER, metavar="NAME", help="default %(default)s"
    )
    parser.add_argument(
        "--time-limit", type=seconds, metavar="S", help="seconds for the search"
    )
    parser.add_argument(
        "--max-explorations",
        type=count,
        default=EXPLORATIONS,
        metavar="N",
        help="rollouts started at most (default %(default)s)",
    )
    parser.add_argument(
        "--improve",
        type=seconds,
        default=0.0,
        metavar="S",
        help="seconds to go on shortening after the first solution",
    )
    parser.add_argument("--out", metavar="DIR", help="write plan.json and reports here")
    parser.add_argument("--seed", type=seed, default=0, help="default 0")


def failure(kind: str, message: str) -> dict[str, Any]:
    """The document of a run that did not come to a plan."""
    if kind not in STATUS:
        return {"error": {"kind": kind, "message": message}}
    return {
        "status": STATUS[kind],
        "message": message,
        "path": None,
        "trajectory": None,
        "certificate": None,
    }


def run(args: argparse.Namespace, out: Output) -> int:
    """Plan, print, write; the exit status is that of the plan's status."""
    target = folder(args.out) if args.out is not None else None
    from rrnn_opt.planning import Problem, plan

    problem = Problem.load(args.problem)
    result = plan(
        problem,
        seed=args.seed,
        planner=args.planner,
        time_limit=args.time_limit,
        max_explorations=args.max_explorations,
        on_progress=_progress(),
        keep_trees=target is not None,
        improve_s=args.improve,
    )
    document = result.to_dict()
    out.document(document)
    out.say(summary(document))
    if target is not None:
        from rrnn_opt.report import write_plan

        for path in write_plan(document, target):
            out.say(f"wrote {path}")
    return result.exit_code


def summary(document: dict[str, Any]) -> str:
    """The result for people."""
    from rrnn_opt.report import table

    proof, stats = document["certificate"] or {}, document["stats"]
    clearance, error = proof.get("clearance_lower_bound"), proof.get("goal_error")
    rows: list[tuple[str, str]] = [("collision-free", proof["collision_free"])]
    rows.append(("limits kept", proof["limits"]))
    if clearance is not None:
        rows.append(("clearance at least [mm]", f"{1e3 * clearance:.3f}"))
    if error is not None:
        rows.append(("goal error [m or rad]", f"{error:.2e}"))
    if document["trajectory"]:
        rows.append(("duration [s]", f"{document['trajectory']['duration']:.3f}"))
    if stats["path_length"] is not None:
        rows.append(("path length [rad or m]", f"{stats['path_length']:.3f}"))
    counts = "{explorations} ({random} random, {heuristic} heuristic)".format(**stats)
    times = "{plan_time_s:.4f} / {retime_time_s:.3f} / {time_s:.3f}".format(**stats)
    rows += [("explorations", counts), ("plan / retime / total [s]", times)]
    head = f"{document['status']}: {document['message']}"
    return head + "\n" + table(("", document["planner"]), rows, indent=2)


def _progress() -> Any:
    """A counter on the terminal, or None where nobody watches."""
    if not sys.stderr.isatty():
        return None

    def show(stage: str, number: int) -> None:
        print(f"\r{stage}: {number}    \r", end="", file=sys.stderr, flush=True)

    return show
