"""Time to find a certificate and to check it, one claim an engine.

``python -m benchmarks.engines`` prints a Markdown table; wall time, the best of
three, with the processes that the engines start.
"""

from __future__ import annotations

import sys
import time
from fractions import Fraction

import casadi as ca

from rrnn_opt.check.claims.certificate import check_certificate
from rrnn_opt.claim import Claim, Hypothesis, Range, Relation
from rrnn_opt.decay import DecayClaim, corner_matrices
from rrnn_opt.robot import Kinematics, Robot
from rrnn_opt.symbolic import Symbol
from rrnn_opt.validation.ending import ended
from rrnn_opt.verification import certify


def projection(size: int) -> Claim:
    """x'P(x) >= |P(x)|^2 for a box that holds 0."""
    x, low, high = (Symbol.vector(name, size) for name in ("x", "low", "high"))
    p = ca.fmin(ca.fmax(x.sx, low.sx), high.sx)
    box = (
        Range("low", (None,) * size, (Fraction(0),) * size),
        Range("high", (Fraction(0),) * size, (None,) * size),
    )
    goal = Relation(ca.dot(x.sx, p) - ca.sumsqr(p), ">=0")
    words = f"projection lemma, {size} joint{'s' * (size > 1)}"
    return Claim("projection", "eq. (21)", words, (x, low, high), goal, domain=box)


def conditioning() -> Claim:
    """The least eigenvalue of JJ' is at least 0.03 where sin q2 >= 1/2."""
    q, arm = Symbol.vector("q", 3), Kinematics(Robot.builtin("planar3"))
    jacobian = ca.substitute(arm.jacobian("tip")[:2, :], arm.q, q.sx)
    m = jacobian @ jacobian.T - 0.03 * ca.SX.eye(2)
    goal = ca.vertcat(m[0, 0] + m[1, 1], m[0, 0] * m[1, 1] - m[0, 1] * m[1, 0])
    bent = Hypothesis("A1", "sin q2 >= 1/2", Relation(ca.sin(q.sx[1]) - 0.5, ">=0"))
    words = "planar arm, lambda_min(JJ') >= 0.03 where sin q2 >= 1/2"
    return Claim("3R", "", words, (q,), Relation(goal, ">=0"), hypotheses=(bent,))


def network() -> DecayClaim:
    """Network (6), W = I/2, every entry of a 2 x 3 Jacobian within 0.05."""

    def matrix(*entries: Fraction) -> list[list[Fraction]]:
        rows = [[Fraction(0)] * 5 for _ in range(5)]
        for k in range(3):
            rows[k][k] = Fraction(-1)
            for r in range(2):
                rows[k][3 + r] = entries[3 * r + k]
                rows[3 + r][k] = -entries[3 * r + k]
        return rows

    middle = [Fraction(n, 12) for n in (12, -6, 3, 4, 12, 6)]
    width = Fraction(1, 20)
    vertices = corner_matrices(matrix, [(x - width, x + width) for x in middle])
    words = "network (6), 64 vertices, rate 1/10"
    return DecayClaim("network", "eq. (6)", words, vertices, Fraction(1, 10))


def row(claim: Claim | DecayClaim, engine: str) -> str:
    """One line of the table."""
    found, checked = [], []
    for _ in range(3):
        begin = time.perf_counter()
        verdict = certify(claim, engines=(engine,))
        found.append(time.perf_counter() - begin)
        assert verdict.certificate is not None, verdict.reason
        begin = time.perf_counter()
        assert check_certificate(verdict.certificate).holds
        checked.append(time.perf_counter() - begin)
    find, check = min(found), min(checked)
    cells = (claim.statement, engine, f"{verdict.status} ({verdict.trust})")
    return f"| {' | '.join(cells)} | {find:.3f} | {check:.4f} | {check / find:.1%} |"


def main() -> None:
    """Print the table."""
    print("| claim | engine | verdict | find, s | check, s | check / find |")
    print("|---|---|---|---|---|---|")
    print(row(projection(7), "products"))
    print(row(projection(1), "smt"))
    print(row(conditioning(), "sos"))
    print(row(network(), "lmi"))


if __name__ == "__main__":
    sys.exit(ended(main))
