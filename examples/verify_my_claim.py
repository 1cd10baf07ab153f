"""A claim about one's own law: PI feedback of a tip error loses energy as designed.

Run it, or let the command line settle it: rrnn verify examples/verify_my_claim.py
"""

import casadi as ca

import rrnn_opt as rr


def claims() -> list[rr.Claim]:
    """With u = kp e + ki z the loop is e' = -kp e - ki z, z' = e."""
    e, z = rr.Symbol.vector("e", 3, "m"), rr.Symbol.vector("z", 3, "m s")
    kp, ki = rr.Symbol.scalar("kp", "1/s"), rr.Symbol.scalar("ki", "1/s^2")
    state = ca.vertcat(e.sx, z.sx)
    rate = ca.vertcat(-kp.sx * e.sx - ki.sx * z.sx, e.sx)
    energy = ca.dot(e.sx, e.sx) / 2 + ki.sx * ca.dot(z.sx, z.sx) / 2
    slope = ca.jtimes(energy, state, rate)
    return [
        rr.Claim(
            id="mine",
            source="this file",
            statement="V = |e|^2/2 + ki |z|^2/2 changes at -kp |e|^2",
            variables=(e, z, kp, ki),
            goal=rr.Relation(slope + kp.sx * ca.dot(e.sx, e.sx), "==0"),
            order="first-order",
        )
    ]


if __name__ == "__main__":
    for claim in claims():
        verdict = rr.certify(claim)
        print(verdict.status, "by", verdict.engine, "- trust", verdict.trust)
