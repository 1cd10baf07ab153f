"""Stage 6: what the demo leaves behind."""

from __future__ import annotations

from pathlib import Path

from rrnn_opt.demo.law import Law
from rrnn_opt.embedding import generate
from rrnn_opt.planning import PlanResult
from rrnn_opt.report import write_plan

PREFIX = "pa10"


def write_all(out: Path, result: PlanResult, law: Law) -> tuple[Path, ...]:
    """plan.json, trajectory.csv, plan.png, plan.html and the controller.

    Raises:
        OSError: the folder cannot be written.
    """
    paths = write_plan(result.to_dict(), out)
    package = generate(law.feedback, prefix=PREFIX, real="float")
    folder = package.write(out / "controller")
    return (*paths, folder)
