"""Arms that nothing was tuned on, in scenes drawn at random, beside OMPL.

    python -m rrnn_opt.validation.studies.generality --scenes 200 --out DIR

Arms of example-robot-data with spheres fitted by ``rrnn spheres`` (in DIR, made
when missing), each in its own random scenes (``clutter``): boxes, cylinders and
spheres within reach, a start and a goal posture drawn until they are free.  The
planner's constants are those of every other scene and stood before the scenes
were drawn.  A scene may have no solution; it then counts as not solved.  Every
scene is one line of DIR/rows.jsonl, which names the commit that made it: a run
that is stopped goes on.  The page has all arms and scenes of DIR that have the
seed, so that arms may be run one by one, in different numbers of scenes.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from rrnn_opt.errors import RrnnError
from rrnn_opt.planning import Problem, RandomRnn, plan
from rrnn_opt.planning.problem.goals import JointGoal
from rrnn_opt.report import write_text
from rrnn_opt.study import Lines, read_lines
from rrnn_opt.study.environment import commit
from rrnn_opt.validation.ending import ended
from rrnn_opt.validation.studies.arms import ARMS, arm, contacts
from rrnn_opt.validation.studies.clutter import scenes
from rrnn_opt.validation.studies.generality_page import kept_lines, page
from rrnn_opt.validation.studies.peer import rrt_connect
from rrnn_opt.validation.tables.searched import searched

BUDGET = 2000
"""Explorations of our search at most: what is solved does not depend on a clock."""
PEER_LIMIT = 4.0
"""Seconds of processor time of OMPL's search, whose checker is called in Python."""
COMMAND = "python -m rrnn_opt.validation.studies.generality"


def measured(name: str, index: int, problem: Problem, peer: bool) -> dict[str, Any]:
    """What one scene gave, ours and OMPL's."""
    found = searched(problem, RandomRnn(), index, BUDGET)
    row = {
        "arm": name,
        "joints": problem.robot.nv,
        "spheres": len(problem.robot.spheres),
        "scene": index,
        "status": found["status"],
        "explorations": found["total"],
        "plan_s": 1e-3 * found["plan_ms"],
    }
    if found["solved"]:
        begin = time.thread_time()
        result = plan(problem, seed=index, max_explorations=BUDGET)
        row |= {"status": result.status, "all_s": time.thread_time() - begin}
    if peer:
        goal = next(g for g in problem.goals if isinstance(g, JointGoal))
        run = rrt_connect(problem, np.asarray(goal.joints), PEER_LIMIT)
        row |= {"peer": run.solved, "peer_s": run.seconds, "peer_cpu_s": run.cpu_s}
    return row


def read(path: Path) -> list[dict[str, Any]]:
    """Finished rows; a line that was cut off by a kill does not count."""
    return [row for row in read_lines(path) if row is not None]


def run(
    names: Sequence[str], out: Path, count: int, seed: int, *, peer: bool = True
) -> Iterator[dict[str, Any]]:
    """Rows of all arms, those of an earlier run among them.

    Args:
        names: of ``ARMS``.
        out: folder of spheres and rows.
        count: scenes an arm.
        seed: of the scenes.
        peer: also run OMPL's RRTConnect.
    """
    out.mkdir(parents=True, exist_ok=True)
    lines = Lines(out / "rows.jsonl")
    done = {(r["arm"], r["scene"], r["seed"]): r for r in lines}
    made = {"seed": seed, "commit": commit()}
    for name in names:
        drawn = scenes(arm(name, out), count, seed)
        for index in range(count):
            row = done.get((name, index, seed))
            problem = next(drawn)
            if row is None:
                row = {**measured(name, index, problem, peer), **made}
                lines.append(row)
            yield row


def found_arms(rows: Sequence[dict[str, Any]]) -> list[str]:
    """Arms of some rows, in their order."""
    return list(dict.fromkeys(row["arm"] for row in rows))


def earlier_page(name: str) -> str:
    """The page as it was kept at a commit of the checkout.

    Raises:
        RrnnError: there is no checkout, or no such page in it.
    """
    here = Path(__file__).resolve().parent
    words = ["git", "-C", str(here), "show", "--end-of-options"]
    words.append(f"{name}:docs/results/generality.md")
    try:
        done = subprocess.run(words, capture_output=True, text=True, check=True)
    except (OSError, subprocess.SubprocessError, ValueError) as error:
        said = (getattr(error, "stderr", "") or str(error)).splitlines()
        raise RrnnError(
            f"--earlier {name[:40]}: no page of that commit ({said[0]}); run from a"
            " checkout that has it, or leave --earlier out"
        ) from error
    return done.stdout


def main(argv: Sequence[str] | None = None) -> int:
    """Run the study and write ``generality.md``."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--arms", nargs="+", default=list(ARMS), choices=list(ARMS))
    parser.add_argument("--scenes", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--no-peer", action="store_true", help="without OMPL")
    parser.add_argument("--earlier", help="commit whose page has the missing arms")
    parser.add_argument("--out", type=Path, required=True)
    args = parser.parse_args(argv)
    earlier = earlier_page(args.earlier) if args.earlier else ""
    peer = not args.no_peer
    for _ in run(args.arms, args.out, args.scenes, args.seed, peer=peer):
        pass
    rows = [r for r in read(args.out / "rows.jsonl") if r["seed"] == args.seed]
    rows.sort(key=lambda r: (list(ARMS).index(r["arm"]), r["scene"]))
    command = f"{COMMAND} --arms ARM --scenes SCENES --seed {args.seed} --out DIR"
    command += f" --earlier {args.earlier}" if args.earlier else ""
    found = contacts(args.out, found_arms(rows))
    text = page(rows, command, found, (BUDGET, PEER_LIMIT))
    if args.earlier:
        text += kept_lines(earlier, args.earlier, found_arms(rows))
    write_text(args.out / "generality.md", text)
    return 0


if __name__ == "__main__":
    sys.exit(ended(main))
