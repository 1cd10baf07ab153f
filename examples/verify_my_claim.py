"""A claim of one's own: a saturated linear loop loses energy."""

import casadi as ca

import rrnn_opt as rr
from rrnn_opt.claim import Relation
from rrnn_opt.symbolic import Symbol

x, gain = Symbol.scalar("x", "1", "state"), Symbol.scalar("gain", "1/s", "gain")
rate = -(gain.sx**2) * x.sx  # x' = -gain^2 x
energy_rate = ca.jtimes(x.sx**2 / 2, x.sx, rate)
claim = rr.Claim(
    id="mine",
    source="this file",
    statement="d/dt x^2/2 = -(gain x)^2 along x' = -gain^2 x",
    variables=(x, gain),
    goal=Relation(energy_rate + (gain.sx * x.sx) ** 2, "==0"),
    order="first-order",
)
verdict = rr.certify(claim)
print(verdict.status, "by", verdict.engine, "- trust", verdict.trust)
