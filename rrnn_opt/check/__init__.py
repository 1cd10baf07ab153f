"""The trusted base: re-checks what others deliver, and shares nothing with them.

Its own forward kinematics from plain arrays, its own distances, its own
bounds.  ``plans`` judges plans, ``claims`` judges certificates of claims; they
know nothing of one another and share ``arithmetic`` alone.  Verdicts are
PROVED, REFUTED (with a witness) or UNKNOWN; samples are never a certificate.
"""

from rrnn_opt.check.plans.document import PlanCheck, check_plan
from rrnn_opt.check.plans.trajectory import (
    Judge,
    TrajectoryCertificate,
    certify_trajectory,
)

__all__ = [
    "Judge",
    "PlanCheck",
    "TrajectoryCertificate",
    "certify_trajectory",
    "check_plan",
]
