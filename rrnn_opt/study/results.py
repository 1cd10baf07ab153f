"""Studies that are stopped and taken up: rows kept in a folder as they are finished."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

from rrnn_opt.study.cases import TIMINGS, Case, Row, Study, Workers, once
from rrnn_opt.study.identity import PACKAGES, identity, surroundings
from rrnn_opt.study.journal import sealed
from rrnn_opt.study.store import Store, set_aside
from rrnn_opt.study.study import local

Watch = Callable[[int, int], None]


class Results:
    """The rows of one or several studies in a folder.

    A row counts for the same study, key, parameters, seed, code and versions
    only; rows of anything else stay where they are and are left out.

    Args:
        folder: of the rows; made where it is missing.
        seed: of the studies.
        resume: go on with what is there; else it is set aside.
        packages: whose versions a row depends on.
        bound: False: a row counts whatever the code and the versions were.

    Attributes:
        folder: the same.
        damaged: rows and parts found broken, which were not counted.

    Raises:
        StoreError: another run writes there.
        OSError: the folder cannot be written.
    """

    def __init__(
        self,
        folder: Path,
        *,
        seed: int = 0,
        resume: bool = True,
        packages: Iterable[str] = PACKAGES,
        bound: bool = True,
    ) -> None:
        if not resume:
            set_aside(folder)
        self.folder, self._seed = folder, seed
        self._around = surroundings(packages) if bound else ""
        self._store = Store(folder)
        self._finished = {bytes.fromhex(e["identity"]) for e in self._store}
        self.damaged = self._store.damaged

    def __enter__(self) -> Results:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Make parts of what was finished last; others may write then."""
        self._store.close()

    def run(
        self,
        study: Study,
        *,
        workers: Workers | None = None,
        jobs: int = 1,
        progress: Watch | None = None,
    ) -> Iterator[Row]:
        """Run what is left of a study, keeping each row before it is yielded.

        Args:
            study: what to run.
            workers: where; ``jobs`` processes by default.
            jobs: worker processes.
            progress: told (finished, all) after each case.

        Raises:
            RrnnError: two cases have the same key.
            OSError: the disk is full, say; what was finished before is kept.
        """
        total = sum(1 for _ in once(study))
        left = sum(1 for _ in self._left(study))
        where = local(jobs) if workers is None else workers
        marks: dict[str, str] = {}
        for row in where.rows(study, self._marked(study, marks), self._seed):
            mark = marks.pop(row.key, None)
            if mark is None:
                continue  # a cluster may finish a case twice; the first one counts
            if not row.lost:
                self._store.append(_entry(mark, study.name, row, self._seed))
                self._finished.add(bytes.fromhex(mark))
            left -= 1
            if progress is not None:
                progress(total - left, total)
            yield row

    def finish(self, study: Study, **options: Any) -> list[Row]:
        """``run`` to the end, then ``rows``.

        Args:
            study: what to run.
            **options: those of ``run``.
        """
        for _ in self.run(study, **options):
            pass
        return self.rows(study)

    def rows(self, study: Study) -> list[Row]:
        """Finished rows of a study, in the study's order."""
        found = {row.key: row for row in self.stream(study)}
        return [found[case.key] for case in study if case.key in found]

    def stream(self, study: Study) -> Iterator[Row]:
        """Finished rows of a study, in any order, one at a time in memory."""
        wanted = {bytes.fromhex(self._mark(study, case)) for case in study}
        for entry in self._store:
            if bytes.fromhex(entry["identity"]) in wanted:
                yield Row(
                    entry["key"], entry["metrics"], entry["error"], entry["time_s"]
                )

    def _mark(self, study: Study, case: Case) -> str:
        return identity(study, case, self._seed, surroundings=self._around)

    def _left(self, study: Study) -> Iterator[tuple[Case, str]]:
        for case in study:
            mark = self._mark(study, case)
            if bytes.fromhex(mark) not in self._finished:
                yield case, mark

    def _marked(self, study: Study, marks: dict[str, str]) -> Iterator[Case]:
        """Cases that are left; what identifies those that are out is noted."""
        for case, mark in self._left(study):
            marks[case.key] = mark
            yield case


def _entry(mark: str, study: str, row: Row, seed: int) -> dict[str, Any]:
    return sealed(
        {
            "identity": mark,
            "study": study,
            "key": row.key,
            "seed": seed,
            "error": row.error,
            "time_s": row.time_s,
            "metrics": dict(row.metrics),
        }
    )


def table(rows: Iterable[Row]) -> bytes:
    """Rows sorted by key as JSON lines, without columns of times.

    Two runs of one study give the same bytes, however often each was stopped
    and wherever it ran.
    """
    lines = [
        json.dumps([row.key, _timeless(row.metrics), row.error], sort_keys=True)
        for row in sorted(rows, key=lambda row: row.key)
    ]
    return "".join(line + "\n" for line in lines).encode()


def rows_digest(rows: Iterable[Row]) -> str:
    """Digest of ``table``, 16 hex digits."""
    return hashlib.sha256(table(rows)).hexdigest()[:16]


def _timeless(value: Any) -> Any:
    """A metric without the entries whose names say that they are times."""
    if isinstance(value, dict):
        return {k: _timeless(v) for k, v in value.items() if not k.endswith(TIMINGS)}
    return value
