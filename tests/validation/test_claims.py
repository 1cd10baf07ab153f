"""The statements of the paper, each with its mutation, on built-in robots."""

from __future__ import annotations

import time
from fractions import Fraction

import casadi as ca
import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.check.claim_certificate import check_certificate
from rrnn_opt.validation.claims import c17, c18, c29, claims
from rrnn_opt.verification import Status, certify

NAMES = ("planar3", "pa10")


@pytest.mark.parametrize("name", NAMES)
def test_every_verdict_is_the_expected_one(name):
    settled = [case.settle() for case in claims(rr.Kinematics(rr.Robot.builtin(name)))]
    assert [s.case.claim.id for s in settled] == ["C17", "C18", "C19", "C29"]
    expected = ["REFUTED", "PROVED", "REFUTED", "PROVED"]
    assert [s.verdict.status for s in settled] == expected
    assert all(s.as_expected for s in settled)
    for each in settled:
        assert check_certificate(each.verdict.certificate).holds


def test_the_identity_is_quick_on_seven_joints():
    case = c18.case(rr.Kinematics(rr.Robot.builtin("pa10")))
    begin = time.perf_counter()
    assert certify(case.claim).status is Status.PROVED
    assert time.perf_counter() - begin < 2.0


@pytest.mark.parametrize("name", NAMES)
def test_the_first_order_law_is_the_box_programmes_optimum(name):
    """The identity speaks of what is computed: P(J'e gain), by numpy."""
    kin = rr.Kinematics(rr.Robot.builtin(name))
    law, error, jacobian = c18.reduced_law(kin)
    symbols = [law.state.sx, *(p.sx for p in law.parameters)]
    fn = ca.Function("law", symbols, [law.output, error, jacobian])
    rng, n = np.random.default_rng(1), kin.robot.nv
    lower, upper = -rng.random(n), rng.random(n)
    args = (rng.standard_normal(n), rng.standard_normal(3), 5.0, lower, upper)
    velocity, e, J = (np.asarray(v, dtype=float) for v in fn(*args))
    np.testing.assert_allclose(
        velocity.ravel(), np.clip(5.0 * (J.T @ e).ravel(), lower, upper), atol=1e-12
    )


@pytest.mark.parametrize("name", NAMES)
def test_the_witness_of_c17_moves_away_from_the_target(name):
    """Finite differences along q' = u see V rise, too."""
    kin = rr.Kinematics(rr.Robot.builtin(name))
    witness = certify(c17.case(kin).claim, witnesses=c17.case(kin).witnesses).witness
    point = {
        k: np.array([float(Fraction(v)) for v in row]) for k, row in witness.items()
    }
    tip = ca.Function("p", [kin.q], [kin.position()])

    def energy(q):
        return 0.5 * np.sum((point["rd"] - np.asarray(tip(q)).ravel()) ** 2)

    h = 1e-5
    before, after = (energy(point["q"] + s * h * point["u"]) for s in (-1, 1))
    assert (after - before) / (2 * h) > 1e-3
    limits = kin.robot.limits
    assert np.all(np.abs(point["u"]) <= limits.velocity)
    assert np.all((point["q"] > limits.lower) & (point["q"] < limits.upper))


def test_the_memory_cell_is_the_one_of_the_claim():
    cell = rr.networks.MemoryCell()
    claim = c29.case().claim
    fn = ca.Function("g", [s.sx for s in claim.variables], [claim.goal.expression])
    for stimulus in (0.0, 0.3, 1.0):
        ends = fn(cell.decay, cell.self_excitation, stimulus)
        at = [float(cell.derivative(ca.SX(x), ca.SX(stimulus))) for x in (0.0, 1.0)]
        np.testing.assert_allclose(np.asarray(ends).ravel(), [at[0], -at[1]])
