"""Cases on this machine: in this process, or in worker processes that may die."""

from __future__ import annotations

import contextlib
import math
import pickle
import signal
import time
import traceback
from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from typing import Any

from rrnn_opt.arguments import checked
from rrnn_opt.errors import RrnnError
from rrnn_opt.study.cases import Case, Row, Study, measured
from rrnn_opt.study.threads import one_thread


class WorkerError(RrnnError):
    """Worker processes cannot be used.

    Attributes:
        reason: what became of them.
    """

    def __init__(self, reason: str) -> None:
        self.reason = reason
        super().__init__(reason)


@dataclass(frozen=True)
class Here:
    """This process, case by case."""

    def rows(self, study: Study, cases: Iterator[Case], seed: int) -> Iterator[Row]:
        """One row a case, in order."""
        yield from (measured(study, case, seed) for case in cases)


@checked()
@dataclass(frozen=True)
class Processes:
    """Worker processes, one case at a time each.

    A worker that dies is replaced, and its case is tried again; after that it
    becomes a row that says so, and the study goes on.  Workers compute with one
    thread each.

    Attributes:
        jobs: worker processes.
        attempts: how often a case may lose its worker.
        patience_s: wall time that a case may take, s; then its worker is ended and
            the case becomes a row that says so.
    """

    jobs: int
    attempts: int = 2
    patience_s: float = math.inf

    def rows(self, study: Study, cases: Iterator[Case], seed: int) -> Iterator[Row]:
        """One row a case, as they are finished.

        Raises:
            WorkerError: a worker died before it could take a case.
        """
        crew = _Crew(study, seed, self)
        try:
            yield from crew.work(cases, self.jobs)
        finally:
            crew.dismiss()


def lost_row(case: Case) -> Row:
    """The row of a case whose worker died each time."""
    error = "WorkerError: every worker that took this case died"
    return Row(case.key, {}, error, lost=True)


@dataclass(eq=False)
class _Worker:
    process: Any
    pipe: Connection
    case: Case | None = None
    ready: bool = False
    since: float = 0.0

    def give(self, case: Case) -> None:
        self.case, self.since = case, time.monotonic()
        with contextlib.suppress(OSError):  # a dead one is noticed when it is read
            self.pipe.send(case)


class _Crew:
    """The workers of one study and what each of them is at."""

    def __init__(self, study: Study, seed: int, rules: Processes) -> None:
        self._study, self._seed, self._rules = study, seed, rules
        self._workers: list[_Worker] = []
        self._again: deque[Case] = deque()
        self._deaths: dict[str, int] = {}

    def work(self, cases: Iterator[Case], jobs: int) -> Iterator[Row]:
        waiting = _Peeking(self._again, cases)
        while True:
            for worker in self._workers:
                if worker.case is None and (case := waiting.take()) is not None:
                    worker.give(case)
            while len(self._workers) < jobs and (case := waiting.take()) is not None:
                self._hire().give(case)
            busy = {w.pipe: w for w in self._workers if w.case is not None}
            if not busy:
                return
            for pipe in wait(list(busy), self._rest(busy.values())):
                row = self._heard(busy[pipe])  # type: ignore[index]
                if row is not None:
                    yield row
            yield from self._late()

    def _rest(self, busy: Iterable[_Worker]) -> float | None:
        """Seconds until the next case is late; None where none ever is."""
        if math.isinf(self._rules.patience_s):
            return None
        first = min(worker.since for worker in busy)
        return max(0.0, first + self._rules.patience_s - time.monotonic())

    def _late(self) -> Iterator[Row]:
        """Rows of cases that took too long; their workers are ended."""
        now, patience = time.monotonic(), self._rules.patience_s
        for worker in list(self._workers):
            if worker.case is None or now - worker.since < patience:
                continue
            worker.process.kill()
            self._dropped(worker)
            error = f"WorkerError: no answer within {patience:g} s"
            yield Row(worker.case.key, {}, error, lost=True)

    def _hire(self) -> _Worker:
        context = get_context("spawn")
        near, far = context.Pipe()
        process = context.Process(
            target=_serve, args=(far, self._study, self._seed), daemon=True
        )
        with one_thread():
            process.start()
        far.close()
        worker = _Worker(process, near)
        self._workers.append(worker)
        return worker

    def _heard(self, worker: _Worker) -> Row | None:
        """A row from a worker; None where it has become ready or has died."""
        try:
            word, data = worker.pipe.recv()
        except (EOFError, OSError):
            return self._died(worker)
        if word == "ready":
            worker.ready = True
            return None
        worker.case = None
        if word == "raised":
            raise _revived(data)
        row: Row = data
        return row

    def _died(self, worker: _Worker) -> Row | None:
        self._dropped(worker)
        case = worker.case
        assert case is not None
        if not worker.ready:
            raise WorkerError(
                "a worker process ended before its first case "
                f"(status {worker.process.exitcode}): run with one job to see why"
            )
        deaths = self._deaths[case.key] = self._deaths.get(case.key, 0) + 1
        if deaths < self._rules.attempts:
            self._again.append(case)
            return None
        return lost_row(case)

    def _dropped(self, worker: _Worker) -> None:
        self._workers.remove(worker)
        worker.process.join()
        worker.pipe.close()

    def dismiss(self) -> None:
        """End all workers, in the middle of a case if need be."""
        for worker in self._workers:
            worker.pipe.close()
            if worker.case is not None:
                worker.process.terminate()
        for worker in self._workers:
            worker.process.join()


class _Peeking:
    """Cases to be repeated first, then those that have not been tried."""

    def __init__(self, again: deque[Case], cases: Iterator[Case]) -> None:
        self._again, self._cases = again, cases

    def take(self) -> Case | None:
        return self._again.popleft() if self._again else next(self._cases, None)


def _serve(pipe: Connection, study: Study, seed: int) -> None:
    """Measure cases until there are no more; Ctrl-C is the parent's business."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    pipe.send(("ready", None))
    while True:
        try:
            case = pipe.recv()
        except (EOFError, OSError):
            return
        try:
            answer: tuple[str, Any] = ("row", measured(study, case, seed))
        except Exception as error:
            answer = ("raised", (_pickled(error), traceback.format_exc()))
        try:
            pipe.send(answer)
        except OSError:
            return


def _pickled(error: Exception) -> bytes | None:
    try:
        data = pickle.dumps(error)
        pickle.loads(data)
    except Exception:
        return None
    return data


def _revived(data: tuple[bytes | None, str]) -> Exception:
    """The exception of a worker, with the text of its traceback as its cause."""
    raw, text = data
    cause = RuntimeError(f"in a worker process:\n{text}")
    if raw is None:
        return cause
    error: Exception = pickle.loads(raw)
    error.__cause__ = cause
    return error
