"""Engines that look for certificates of claims.

An engine proposes; whether a proposal holds is decided in :mod:`rrnn_opt.check`,
which shares nothing with the engines.  ``certify`` is the verb.
"""

from __future__ import annotations

from rrnn_opt.verification.case import ClaimCase, Settled, verdict_row
from rrnn_opt.verification.certify import certify
from rrnn_opt.verification.region import Region, RegionMap, certify_region
from rrnn_opt.verification.verdict import Evidence, Mutation, Status, Verdict

__all__ = [
    "ClaimCase",
    "Evidence",
    "Mutation",
    "Region",
    "RegionMap",
    "Settled",
    "Status",
    "Verdict",
    "certify",
    "certify_region",
    "verdict_row",
]
