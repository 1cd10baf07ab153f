"""Studies: seeded cases in, rows out; the same on one worker or many."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from rrnn_opt.arguments import checked
from rrnn_opt.study.cases import Row, Study, Workers, once


def rows(
    study: Study, *, workers: Workers | None = None, jobs: int = 1, seed: int = 0
) -> Iterator[Row]:
    """Rows as they are finished; leaving early keeps what was yielded.

    Args:
        study: what to run.
        workers: where; ``jobs`` processes by default.
        jobs: worker processes; 1 runs here.
        seed: of the whole study.

    Yields:
        One row a case; in the study's order when ``jobs`` is 1.

    Raises:
        RrnnError: two cases have the same key.
    """
    for _ in once(study):
        pass
    where = local(jobs) if workers is None else workers
    yield from where.rows(study, iter(study), seed)


@checked()
def local(jobs: int) -> Workers:
    """Workers on this machine: this process for one job, else processes."""
    from rrnn_opt.study.processes import Here, Processes

    return Here() if jobs == 1 else Processes(jobs)


def run(
    study: Study,
    *,
    jobs: int = 1,
    seed: int = 0,
    progress: Callable[[int, int], None] | None = None,
) -> list[Row]:
    """All rows in the order of the cases, whatever the number of workers.

    Args:
        study: what to run.
        jobs: worker processes.
        seed: of the whole study.
        progress: told (finished, all) after each case.

    Returns:
        One row a case.
    """
    order = [case.key for case in study]
    finished: dict[str, Row] = {}
    for row in rows(study, jobs=jobs, seed=seed):
        finished[row.key] = row
        if progress is not None:
            progress(len(finished), len(order))
    return [finished[key] for key in order]
