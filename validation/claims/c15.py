"""C15: under (16) a first error accumulates with time."""

from __future__ import annotations

import casadi as ca
import numpy as np

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Evidence, Mutation, Repair
from rrnn_opt.verification.lemmas import clip
from rrnn_opt.verification.vocabulary import stated

SEED, RUNS, SIGMA = 0, 200, 0.05


def case(kinematics: Kinematics) -> ClaimCase:
    """With e not 0 the loop (6b), (16) is never at rest, for a target at rest.

    An error that accumulates keeps changing; so wherever e is not 0 some of
    (q', u', lam') must not be 0.  At u = 0 and lam = 0 all are, whatever e is:
    the error stays what it was.  Along the loop e - epsilon lam is constant
    (C14), which is the repaired statement; noise of the joints that lam does
    not hear of does accumulate, and that is evidence from samples.

    Args:
        kinematics: kinematics of the robot.
    """
    n = kinematics.robot.nv
    q = Symbol("q", kinematics.q, "rad or m", "joint positions")
    u, lam = Symbol.vector("u", n, "rad/s or m/s"), Symbol.vector("lam", 3)
    rd, gain = Symbol.vector("rd", 3, "m"), Symbol.scalar("gain", "1/s", "1/epsilon")
    low, high = Symbol.vector("low", n), Symbol.vector("high", n)
    J, e = kinematics.jacobian(), rd.sx - kinematics.position()
    moved = gain.sx * (clip(J.T @ lam.sx, low.sx, high.sx) - u.sx)
    rates = ca.vertcat(u.sx, moved, -gain.sx * (J @ u.sx))
    printed = Claim(
        id="C15",
        source="eq. (16)",
        statement="a first error e is not 0 makes the error change with time",
        variables=(q, u, lam, rd, gain, low, high),
        goal=Relation(ca.dot(rates, rates), ">0"),
        hypotheses=(
            stated("H1", "e is not 0", ca.dot(e, e), ">0"),
            stated("H2", "0 lies in Omega", ca.vertcat(high.sx, -low.sx)),
            stated("H3", "epsilon > 0", gain.sx, ">0"),
        ),
        order="second-order",
        jacobian="moving",
    )
    witness = {
        "q": [0] * n, "u": [0] * n, "lam": [0] * 3, "rd": (9, 9, 9), "gain": (1,),
        "low": [-1] * n, "high": [1] * n,
    }  # fmt: skip
    mended = _moves_together(kinematics, q, u)
    mutation = Mutation("e - epsilon lam constant", mended, holds=True)
    found = tuple(_spread(until) for until in (5.0, 20.0))
    return ClaimCase(printed, mutation, (witness,), Repair(mended), evidence=found)


def _moves_together(kinematics: Kinematics, q: Symbol, u: Symbol) -> Claim:
    """The repaired statement: f(q)' is J u."""
    velocity = ca.jtimes(kinematics.position(), q.sx, u.sx)
    return Claim(
        id="C15",
        source="eq. (15)-(16)",
        statement="without noise e - epsilon lam is constant: e moves as lam does",
        variables=(q, u),
        goal=Relation(-velocity + kinematics.jacobian() @ u.sx, "==0"),
        order="second-order",
        jacobian="moving",
    )


def _spread(until: float) -> Evidence:
    """Standard deviation of e after noise that lam does not hear of, J = 1."""
    rng, h, epsilon = np.random.default_rng(SEED), 0.01, 0.1
    e, u, lam = np.zeros(RUNS), np.zeros(RUNS), np.zeros(RUNS)
    for _ in range(int(until / h)):
        noise = SIGMA * np.sqrt(h) * rng.standard_normal(RUNS)
        e, lam = e - h * u - noise, lam - h * u / epsilon
        u = u + h * (lam - u) / epsilon
    spread = float(np.std(e))
    half = 1.96 * spread / np.sqrt(2 * RUNS)
    return Evidence("C15", "sampled", RUNS, (spread - half, spread + half), SEED)
