"""Cases on a Dask cluster."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from rrnn_opt.arguments import checked
from rrnn_opt.study.cases import Case, Row, Study, measured
from rrnn_opt.study.processes import WorkerError, lost_row

PATIENCE_S = 30.0


@checked()
@dataclass(frozen=True)
class Cluster:
    """The workers of a Dask scheduler, whichever come and go.

    A case whose worker is lost is given to another by the scheduler, as often as
    its setting ``distributed.scheduler.allowed-failures`` says.  Workers must
    have one thread each (``dask worker ADDRESS --nthreads 1``): more of them
    would share one interpreter, and no time measured would mean anything.  A worker
    ends the case it has before it takes another, also when whoever asked is gone:
    there is no limit of time here, and one that hangs is freed by ending its worker.

    Attributes:
        address: of the scheduler, e.g. "tcp://127.0.0.1:8786".
        ahead: cases given out for each worker, so that none waits.
    """

    address: str
    ahead: int = 3

    def rows(self, study: Study, cases: Iterator[Case], seed: int) -> Iterator[Row]:
        """One row a case, as they are finished.

        Raises:
            WorkerError: ``distributed`` is not installed, nobody answers at the
                address, or a worker has several threads.
        """
        client = self._client()
        try:
            yield from self._work(client, study, cases, seed)
        finally:
            client.close()

    def _client(self) -> Any:
        try:
            from distributed import Client
        except ImportError as error:
            raise WorkerError(
                "a Dask cluster needs the extra: pip install 'rrnn_opt[study]'"
            ) from error
        try:
            client = Client(self.address, timeout=PATIENCE_S, set_as_default=False)
            client.wait_for_workers(1, timeout=PATIENCE_S)
        except (OSError, ValueError) as error:
            raise WorkerError(
                f"no Dask cluster with workers answers at {self.address}"
            ) from error
        if any(threads > 1 for threads in client.nthreads().values()):
            client.close()
            raise WorkerError("start every Dask worker with --nthreads 1")
        return client

    def _work(
        self, client: Any, study: Study, cases: Iterator[Case], seed: int
    ) -> Iterator[Row]:
        from distributed import as_completed

        out: dict[str, Case] = {}
        finished, room = as_completed(loop=client.loop), 0
        while True:
            if len(out) <= room // 2:
                room = self.ahead * max(1, len(client.nthreads()))
            while len(out) < room and (case := next(cases, None)) is not None:
                future = client.submit(measured, study, case, seed, pure=False)
                out[future.key] = case
                finished.add(future)
            if not out:
                return
            future = next(finished)
            yield self._row(future, out.pop(future.key))

    def _row(self, future: Any, case: Case) -> Row:
        from distributed import KilledWorker

        try:
            row: Row = future.result()
        except KilledWorker:
            return lost_row(case)
        finally:
            future.release()
        return row
