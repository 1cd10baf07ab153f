"""Solvers of QPs compared on streams of control problems and on drawn sets."""

from rrnn_opt.study.comparison.catalogue import GROUPS, installed, set_names
from rrnn_opt.study.comparison.entrants import Entrant, chosen, entrants
from rrnn_opt.study.comparison.interchange import (
    is_own,
    named_set,
    own_sets,
    write_test_set,
)
from rrnn_opt.study.comparison.measure import Comparison
from rrnn_opt.study.comparison.page import write_report
from rrnn_opt.study.comparison.problem_set import ProblemSet
from rrnn_opt.study.comparison.summary import summaries

__all__ = [
    "GROUPS",
    "Comparison",
    "Entrant",
    "ProblemSet",
    "chosen",
    "entrants",
    "installed",
    "is_own",
    "named_set",
    "own_sets",
    "set_names",
    "summaries",
    "write_report",
    "write_test_set",
]
