"""Plan for hours, and let the independent checker judge every answer.

``python -m benchmarks.soak [--hours H]`` takes up every shipped scenario and
start with ever new seeds.  Each plan is one line of ``results/soak.jsonl``; a
run that is stopped goes on where it ended.  Nothing may be called solved that
the checker does not prove again, or whose motion, followed by conservative
advancement on coal's distances, touches anything.  The table is
``results/soak.md``.
"""

from __future__ import annotations

import argparse
import datetime
import itertools
import json
import platform
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

from benchmarks.follow import follow
from rrnn_opt.check import check_plan
from rrnn_opt.planning import Problem, plan
from rrnn_opt.report import table, write_text
from rrnn_opt.scene.library import SCENARIOS, scenario
from rrnn_opt.study import wilson

RESULTS = Path(__file__).parent / "results"
LINES = RESULTS / "soak.jsonl"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--hours", type=float, default=8.0)
    end = time.monotonic() + 3600.0 * parser.parse_args().hours
    done = len(rows())
    with LINES.open("a", encoding="utf-8") as file:
        for name, start, seed in itertools.islice(cases(), done, None):
            if time.monotonic() > end:
                break
            file.write(json.dumps(judged(name, start, seed)) + "\n")
            file.flush()
    text = report(rows())
    write_text(RESULTS / "soak.md", text)
    print(text)
    return 1 if any(row["overstated"] for row in rows()) else 0


def cases() -> Iterator[tuple[str, int, int]]:
    """Scenario, start and seed, without end and always in the same order."""
    starts = {name: len(scenario(name).starts) for name in SCENARIOS}
    for seed in itertools.count():
        for name, count in starts.items():
            for start in range(count):
                yield name, start, seed


def judged(name: str, start: int, seed: int) -> dict[str, object]:
    """One plan and what the checker finds of it."""
    problem = Problem.from_dict(scenario(name).problem(start))
    document = plan(problem, seed=seed).to_dict()
    found = check_plan(document)
    stats = document["stats"]
    solved = document["status"] == "solved"
    walked = follow(document) if solved else None
    return {
        "scenario": name,
        "start": start,
        "seed": seed,
        "status": document["status"],
        "overstated": bool(found.disagreements)
        or (walked is not None and (walked.least <= 0.0 or walked.outside > 1e-9)),
        "least_gap_m": None if walked is None else walked.least,
        "explorations": stats["explorations"],
        "plan_time_s": stats["plan_time_s"],
    }


def rows() -> list[dict]:
    """What was finished; a line that was cut off by a kill is dropped."""
    if not LINES.exists():
        return []
    whole = LINES.read_text("utf-8").rpartition("\n")[0]
    write_text(LINES, whole + "\n" if whole else "")
    return [json.loads(line) for line in whole.splitlines()]


def report(found: list[dict]) -> str:
    """The small table that is kept."""
    body = []
    for name in SCENARIOS:
        mine = [row for row in found if row["scenario"] == name]
        solved = sum(row["status"] == "solved" for row in mine)
        bad = sum(row["overstated"] for row in mine)
        span = wilson(solved, len(mine)) if mine else (0.0, 1.0)
        shown = f"{span[0]:.4f} to {span[1]:.4f}"
        body.append((name, len(mine), solved, shown, bad))
    header = ("scenario", "plans", "solved", "95 % interval", "overstated")
    words = ["git", "rev-parse", "--short", "HEAD"]
    commit = subprocess.run(words, capture_output=True, text=True, check=False)
    date = datetime.datetime.now(datetime.UTC).date()
    where = f"commit {commit.stdout.strip()}, {platform.machine()}, {date}"
    return f"# Soak\n\n{where}\n\n```\n{table(header, body)}\n```\n"


if __name__ == "__main__":
    sys.exit(main())
