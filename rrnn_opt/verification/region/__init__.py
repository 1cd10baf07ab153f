"""The rate of the reduced law (18) over regions of joint space, certified."""

from rrnn_opt.verification.region.certify import certify_region
from rrnn_opt.verification.region.result import Region, RegionCell, RegionMap

__all__ = ["Region", "RegionCell", "RegionMap", "certify_region"]
