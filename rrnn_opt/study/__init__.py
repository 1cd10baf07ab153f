"""Seeded studies: cases in, rows out, the same on any number of workers."""

from rrnn_opt.study.study import Case, Row, Study, generator, rows, run
from rrnn_opt.study.wilson import wilson

__all__ = ["Case", "Row", "Study", "generator", "rows", "run", "wilson"]
