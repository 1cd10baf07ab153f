"""A claim of one's own: a scalar loop loses energy at the rate one thinks.

Run it, or let the command line settle it: rrnn verify examples/verify_my_claim.py
"""

import casadi as ca

import rrnn_opt as rr
from rrnn_opt.claim import Relation
from rrnn_opt.symbolic import Symbol


def claims() -> list[rr.Claim]:
    """One claim; the graph that is proved is the graph written here."""
    x, gain = Symbol.scalar("x", "1", "state"), Symbol.scalar("gain", "1/s", "gain")
    rate = -(gain.sx**2) * x.sx
    energy_rate = ca.jtimes(x.sx**2 / 2, x.sx, rate)
    return [
        rr.Claim(
            id="mine",
            source="this file",
            statement="d/dt x^2/2 = -(gain x)^2 along x' = -gain^2 x",
            variables=(x, gain),
            goal=Relation(energy_rate + (gain.sx * x.sx) ** 2, "==0"),
            order="first-order",
        )
    ]


if __name__ == "__main__":
    for claim in claims():
        verdict = rr.certify(claim)
        print(verdict.status, "by", verdict.engine, "- trust", verdict.trust)
