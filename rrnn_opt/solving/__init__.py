"""Solvers of QPs and settled networks alike, every answer judged by us."""

from rrnn_opt.solving.active_set import ActiveSet
from rrnn_opt.solving.backends import TIGHT, Qpsolvers
from rrnn_opt.solving.compare import Comparison, Tolerances, compare
from rrnn_opt.solving.infeasible import Farkas, farkas_margin, find_farkas
from rrnn_opt.solving.parts import Duals
from rrnn_opt.solving.protocol import Instance, Solution, Solver
from rrnn_opt.solving.register import register_qpsolvers, unregister_qpsolvers
from rrnn_opt.solving.residual import Residual, judge, kkt_residual
from rrnn_opt.solving.sessions import DaqpSession, OsqpSession
from rrnn_opt.solving.settle import SettleInfo, settle
from rrnn_opt.solving.settled import SettledNetwork
from rrnn_opt.solving.status import Status
from rrnn_opt.solving.stream import Stream, record_stream

__all__ = [
    "TIGHT",
    "ActiveSet",
    "Comparison",
    "DaqpSession",
    "Duals",
    "Farkas",
    "Instance",
    "OsqpSession",
    "Qpsolvers",
    "Residual",
    "SettleInfo",
    "SettledNetwork",
    "Solution",
    "Solver",
    "Status",
    "Stream",
    "Tolerances",
    "compare",
    "farkas_margin",
    "find_farkas",
    "judge",
    "kkt_residual",
    "record_stream",
    "register_qpsolvers",
    "settle",
    "unregister_qpsolvers",
]
