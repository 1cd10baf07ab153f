"""The statements of the paper, each with its mutation, on built-in robots."""

from __future__ import annotations

import tomllib
from fractions import Fraction

import casadi as ca
import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.check.claims.certificate import check_certificate
from rrnn_opt.validation.claims import IDS, c17, c18, c29, claims
from rrnn_opt.validation.claims.expected import TABLE, surprises
from rrnn_opt.verification import ClaimCase, Status, certify

NAMES = ("planar3", "pa10")


QUICK = [
    "C1", "C2", "C3", "C4", "C12", "C13", "C14", "C15", "C16", "C17", "C18", "C23",
    "C23p", "C26", "C29", "C34", "C37", "C39",
]  # fmt: skip
"""Statements that need no solver."""
OF_ROBOTS = ["C1", "C12", "C13", "C14", "C15", "C17", "C18"]


def settle(names, robot):
    entries = claims(rr.Kinematics(rr.Robot.builtin(robot)), names)
    settled = [entry.settle() for entry in entries if isinstance(entry, ClaimCase)]
    remarks = [entry.row() for entry in entries if not isinstance(entry, ClaimCase)]
    assert all(one.caught for one in settled), [
        one.row() for one in settled if not one.caught
    ]
    assert surprises([one.row() for one in settled] + remarks) == {}
    return settled


def again(certificate):
    checked = check_certificate(certificate)
    return checked.holds and checked.status == certificate["status"]


@pytest.mark.parametrize(
    ("names", "robot"), [(QUICK, "planar3"), (OF_ROBOTS, "pa10")], ids=NAMES
)
def test_verdicts_are_the_expected_ones(names, robot):
    for one in settle(names, robot):
        assert again(one.verdict.certificate)
        if one.verdict.status == "REFUTED":
            assert one.verdict.witness


@pytest.mark.slow
def test_so_are_all_others():
    rest = [name for name in IDS if name not in QUICK]
    settled = settle(rest, "planar3")
    assert len(settled) >= 18
    for one in settled:
        if one.verdict.status != "UNKNOWN":
            assert again(one.verdict.certificate)
        if one.mended is not None:
            assert one.mended.status in ("PROVED", "HOLDS_UNDER")


def test_the_table_names_every_row_once():
    table = tomllib.loads(TABLE.read_text())
    named = [name for names in table.values() for name in names]
    assert sorted(named) == sorted(IDS)
    assert len(IDS) == 44


def test_no_row_says_what_its_verdict_should_be():
    words = ("PROVED", "REFUTED", "HOLDS_UNDER", "expected")
    for stem in IDS.values():
        text = (TABLE.parent / f"{stem}.py").read_text()
        assert not any(word in text for word in words), stem


def test_a_surprise_is_one():
    row = {"id": "C17", "verdict": "PROVED", "kind": "PROPOSITION"}
    assert surprises([row]) == {"C17": "REFUTED"}
    assert surprises([row | {"id": "C99"}]) == {"C99": "no such row"}


def test_the_identity_is_proved_for_seven_joints():
    case = c18.case(rr.Kinematics(rr.Robot.builtin("pa10")))
    assert certify(case.claim).status is Status.PROVED


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
    claim = c29.case(None).claim
    fn = ca.Function("g", [s.sx for s in claim.variables], [claim.goal.expression])
    for stimulus in (0.0, 0.3, 1.0):
        ends = fn(cell.decay, cell.self_excitation, stimulus)
        at = [float(cell.derivative(ca.SX(x), ca.SX(stimulus))) for x in (0.0, 1.0)]
        np.testing.assert_allclose(np.asarray(ends).ravel(), [at[0], -at[1]])
