"""Seeded studies: cases in, rows out, kept; the same on any number of workers."""

from rrnn_opt.study.cases import Case, Row, Study, Workers, generator
from rrnn_opt.study.cluster import Cluster
from rrnn_opt.study.environment import environment, processor
from rrnn_opt.study.lines import Lines, read_lines
from rrnn_opt.study.processes import Here, Processes, WorkerError
from rrnn_opt.study.progress import Progress
from rrnn_opt.study.results import Results, rows_digest, table
from rrnn_opt.study.store import Store, StoreError
from rrnn_opt.study.study import local, rows, run
from rrnn_opt.study.threads import one_thread, pin_threads
from rrnn_opt.study.wilson import wilson

__all__ = [
    "Case",
    "Cluster",
    "Here",
    "Lines",
    "Processes",
    "Progress",
    "Results",
    "Row",
    "Store",
    "StoreError",
    "Study",
    "WorkerError",
    "Workers",
    "environment",
    "generator",
    "local",
    "one_thread",
    "pin_threads",
    "processor",
    "read_lines",
    "rows",
    "rows_digest",
    "run",
    "table",
    "wilson",
]
