"""Claims about systems that are no robots: a saturated loop, and a pendulum.

Run it, or let the command line settle it: rrnn verify examples/verify_other_systems.py
"""

from fractions import Fraction

import casadi as ca

import rrnn_opt as rr


def saturated_loop() -> rr.Claim:
    """An unstable x' = x/2 + u with u = -2 x cut to [-1, 1], near its origin."""
    x = rr.Symbol.scalar("x", "1", "state")
    u = ca.fmin(ca.fmax(-2 * x.sx, -1), 1)
    return rr.Claim(
        id="saturated_loop",
        source="this file",
        statement="V = x^2/2 does not grow for |x| <= 2, as far as the bound holds",
        variables=(x,),
        goal=rr.Relation(x.sx * (x.sx / 2 + u), "<=0"),
        domain=(rr.Range("x", (Fraction(-2),), (Fraction(2),)),),
        order="first-order",
    )


def pendulum() -> list[rr.Claim]:
    """A damped pendulum: what its energy does, and how hard it pulls."""
    angle, speed = rr.Symbol.scalar("angle", "rad"), rr.Symbol.scalar("speed", "rad/s")
    state, rate = ca.vertcat(angle.sx, speed.sx), -ca.sin(angle.sx) - speed.sx / 2
    energy = speed.sx**2 / 2 + 1 - ca.cos(angle.sx)
    loss = ca.jtimes(energy, state, ca.vertcat(speed.sx, rate))
    swing = rr.Range("angle", (Fraction(-1),), (Fraction(1),))
    return [
        rr.Claim(
            id="pendulum_energy",
            source="this file",
            statement="the energy falls by speed^2/2 a second",
            variables=(angle, speed),
            goal=rr.Relation(loss + speed.sx**2 / 2, "==0"),
            order="second-order",
        ),
        rr.Claim(
            id="pendulum_pull",
            source="this file",
            statement="within one radian gravity pulls with less than 0.85",
            variables=(angle,),
            goal=rr.Relation(ca.sin(angle.sx) ** 2 - 0.85**2, "<0"),
            domain=(swing,),
        ),
    ]


def claims() -> list[rr.Claim]:
    """All three."""
    return [saturated_loop(), *pendulum()]


if __name__ == "__main__":
    for claim in claims():
        verdict = rr.certify(claim)
        print(claim.id, verdict.status, "by", verdict.engine, "- trust", verdict.trust)
