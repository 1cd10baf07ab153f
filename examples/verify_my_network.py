"""Claims about the gradient network of one's own QP, one for each kind of verdict.

The programme is min x'P x / 2 - c'x, its optimum s solves P s = c, and the network
is x' = -gain (P x - c).  How fast does V = |x - s|^2 / 2 fall?

Run it, or let the command line settle it: rrnn verify examples/verify_my_network.py
"""

import casadi as ca

import rrnn_opt as rr
from rrnn_opt.verification import ClaimCase, Mutation

P = ca.SX([[2, 1], [1, 3]])  # eigenvalues 1.38 and 3.62
x, s, c = (rr.Symbol.vector(name, 2) for name in ("x", "s", "c"))
gain = rr.Symbol.scalar("gain", "1/s")
optimum = rr.Hypothesis(
    "A0", "s is the optimum: P s = c", rr.Relation(P @ s.sx - c.sx, "==0")
)
fast = rr.Hypothesis(
    "A1", "the gain is at least 1/s", rr.Relation(gain.sx - 1, ">=0"), added=True
)


def decay(name: str, rate: float, *given: rr.Hypothesis) -> rr.Claim:
    """V' <= -rate V along the network."""
    error = x.sx - s.sx
    energy = ca.dot(error, error) / 2
    slope = ca.jtimes(energy, x.sx, -gain.sx * (P @ x.sx - c.sx))
    return rr.Claim(
        id=name,
        source="this file",
        statement=f"V' <= -{rate:g} V",
        variables=(x, s, c, gain),
        goal=rr.Relation(slope + rate * energy, "<=0"),
        hypotheses=(optimum, *given),
        order="first-order",
    )


def claims() -> list[ClaimCase]:
    """One that holds under A1, checked by a mutation, and two that do not come out."""
    y = rr.Symbol.scalar("y", "1")
    bound = rr.Relation(ca.exp(y.sx) - y.sx - 1, ">=0")
    return [
        ClaimCase(decay("rate", 2, fast), Mutation("rate 3", decay("fast", 3, fast))),
        ClaimCase(decay("no_gain", 2)),
        ClaimCase(rr.Claim("exp", "calculus", "exp y >= 1 + y", (y,), bound)),
    ]


if __name__ == "__main__":
    for case in claims():
        verdict = rr.certify(case.claim)
        print(case.claim.id, verdict.status, verdict.witness or verdict.residue)
