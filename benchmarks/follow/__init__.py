"""Follow a delivered trajectory by conservative advancement on coal's distances.

A second opinion on ``check``: kinematics by pinocchio, distances by coal.  At
time t a pair of a sphere and a convex solid (or of two spheres) has the gap g
along the normal n, and g changes at the rate c = n.v.  While no sphere speeds
up by more than A, the gap is at least

    g + c s - A s^2 / 2   at time t + s,

for the solid stays behind the plane through its nearest point.  Every pair moves
on until its bound is used up and is asked again: no collision fits in between.
Below ``FLOOR_S`` time moves on by that much all the same, and the count of such
steps is told.
"""

from benchmarks.follow.dense import sampled
from benchmarks.follow.ends import ends_error
from benchmarks.follow.walk import Followed, follow

__all__ = ["Followed", "ends_error", "follow", "sampled"]
