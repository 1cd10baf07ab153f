"""Boxes a second of the interval engine on one core, and finding beside checking.

All times are CPU times of one process, compilation apart (kernels are cached).
"kernel" rows enclose det(J J') over boxes; "proof" rows run the whole search and
then the independent checker on its certificate, whose ratio is checking over
finding.  "region" rows bound sigma_min(J) over boxes (the joints that matter).
"""

from __future__ import annotations

import time
from collections.abc import Callable
from fractions import Fraction

import casadi as ca
import numpy as np

import rrnn_opt as rr
from benchmarks.record import Benchmark, Row
from rrnn_opt.check.claims.certificate import check_certificate
from rrnn_opt.claim import Claim, Range, Relation
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification.blocks import rate_claim
from rrnn_opt.verification.engines.interval.engine import propose
from rrnn_opt.verification.engines.interval.kernel import IntervalKernel
from rrnn_opt.verification.region.reduced import ReducedArm
from rrnn_opt.verification.region.singular import SingularBound

BOXES, REPEATS = 40_960, 7


def cpu_seconds(call: Callable[[], object]) -> float:
    """Least CPU time of a few calls, the first one apart."""
    call()
    times = []
    for _ in range(REPEATS):
        begin = time.process_time()
        call()
        times.append(time.process_time() - begin)
    return min(times)


def boxes(joints: int, half: float) -> tuple[np.ndarray, np.ndarray]:
    centre = np.random.default_rng(0).uniform(-2.0, 2.0, (joints, BOXES))
    return centre - half, centre + half


def kernel_rows(name: str) -> list[Row]:
    kin = rr.Kinematics(rr.Robot.builtin(name))
    J = kin.jacobian()
    J = J[[i for i in range(3) if not J[i, :].is_zero()], :]
    kernel = IntervalKernel.of(ca.Function("det", [kin.q], [ca.det(J @ J.T)]))
    seconds = cpu_seconds(lambda: kernel(*boxes(kin.robot.nv, 0.02)))
    label = f"kernel, {name}, {kin.robot.nv} joints, {kernel.tape.n_values} values"
    return [Row(label, BOXES / seconds, "boxes/s")]


def region_rows(name: str) -> list[Row]:
    arm = ReducedArm.of(rr.Kinematics(rr.Robot.builtin(name)))
    bound = SingularBound.of(arm)
    seconds = cpu_seconds(lambda: bound(*boxes(len(arm.joints), 0.02)))
    label = f"region, {name}, {len(arm.joints)} joints matter"
    return [Row(label, BOXES / seconds, "boxes/s")]


def arm_claim(name: str, least: float, centre: tuple[float, ...], half: float) -> Claim:
    """lambda_min(J J') > least over a box of the joints that matter."""
    arm = ReducedArm.of(rr.Kinematics(rr.Robot.builtin(name)))
    q = Symbol("q", arm.q, "rad", "joints that matter")
    M = arm.J @ arm.J.T - least * ca.SX.eye(len(arm.rows))
    minors = [ca.det(M[:k, :k]) for k in range(1, len(arm.rows) + 1)]
    low = tuple(Fraction(str(c)) - Fraction(str(half)) for c in centre)
    high = tuple(Fraction(str(c)) + Fraction(str(half)) for c in centre)
    goal = Relation(ca.vertcat(*minors), ">0")
    return Claim(f"{name}-{least}", "", "", (q,), goal, domain=(Range("q", low, high),))


def saturated_claim() -> Claim:
    """V' <= -V / 20 on the planar arm, saturation included."""
    arm = ReducedArm.of(rr.Kinematics(rr.Robot.builtin("planar3")))
    q = Symbol("q", arm.q, "rad", "joints that matter")
    e = Symbol("e", ca.SX.sym("e", 2), "rad and m", "direction and length of e")
    number = Fraction
    domain = (
        Range(
            "q", (number("0.5236"), number("-2.4")), (number("2.6179"), number("2.4"))
        ),
        Range("e", (number(-22, 7), number(1, 100)), (number(22, 7), number(1, 2))),
    )
    law = {"epsilon": 0.1, "delta": 0.25, "alpha": 0.05}
    return rate_claim("rate", "", q, arm.J, e, domain=domain, **law)


def proof_rows(label: str, claim: Claim) -> list[Row]:
    (document,) = propose(claim, budget_s=120.0, seed=0)
    nodes = document["payload"]["nodes"]
    find = cpu_seconds(lambda: list(propose(claim, budget_s=120.0, seed=0)))
    begin = time.process_time()
    answer = check_certificate(document)
    check = time.process_time() - begin
    assert answer.status == "PROVED", answer.reason
    return [
        Row(f"proof, {label}: found, {nodes} boxes", find, "s"),
        Row(f"proof, {label}: boxes a second", nodes / find, "boxes/s"),
        Row(f"proof, {label}: checked ({answer.trust})", check, "s", check / find),
    ]


def run(benchmark: Benchmark) -> None:
    for name in ("planar3", "pa10", "panda"):
        benchmark.add(*kernel_rows(name))
    for name in ("planar3", "pa10", "panda"):
        benchmark.add(*region_rows(name))
    planar = arm_claim("planar3", 0.035, (1.57075, 0.0), 1.04715)
    benchmark.add(*proof_rows("3R, lambda_min >= 0.035", planar))
    benchmark.add(*proof_rows("3R, V' <= -V/20, saturated", saturated_claim()))
    posture = (1.15, -0.15, 1.81, 0.6, 1.3)
    seven = arm_claim("pa10", 0.04, posture, 0.15)
    benchmark.add(*proof_rows("PA10, lambda_min >= 0.04, 0.3 rad wide", seven))
