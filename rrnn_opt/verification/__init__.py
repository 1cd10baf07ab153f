"""Engines that look for certificates of claims.

An engine proposes; whether a proposal holds is decided in :mod:`rrnn_opt.check`,
which shares nothing with the engines.  ``certify`` is the verb.
"""

from __future__ import annotations

from rrnn_opt.verification.case import (
    ClaimCase,
    Mutation,
    Remark,
    Repair,
    Settled,
    verdict_row,
)
from rrnn_opt.verification.certify import certify
from rrnn_opt.verification.composite import Given, Instance, Proof, Square, settle
from rrnn_opt.verification.region import Region, RegionMap, certify_region
from rrnn_opt.verification.verdict import Evidence, Status, Verdict

__all__ = [
    "ClaimCase",
    "Evidence",
    "Given",
    "Instance",
    "Mutation",
    "Proof",
    "Region",
    "RegionMap",
    "Remark",
    "Repair",
    "Settled",
    "Square",
    "Status",
    "Verdict",
    "certify",
    "certify_region",
    "settle",
    "verdict_row",
]
