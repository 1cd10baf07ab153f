"""Claims that come with formulations, on several robots."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.check.claims.certificate import check_certificate
from rrnn_opt.errors import RrnnError
from rrnn_opt.verification import settle
from rrnn_opt.verification.catalogue import (
    claims,
    clearance_is_kept,
    equilibrium_is_optimum,
    exponential_rate,
    limits_are_kept,
)
from rrnn_opt.verification.engines.points.rationals import exact_values


def kinematics(name):
    return rr.Kinematics(rr.Robot.builtin(name))


def by_id(found):
    return {case.claim.id: case for case in found}


@pytest.mark.parametrize("name", ["planar3", "pa10"])
@pytest.mark.parametrize("scheme", ["closed_loop", "position_feedback"])
def test_a_rest_point_is_an_optimum(name, scheme):
    kin = kinematics(name)
    verdict = settle(equilibrium_is_optimum(getattr(rr.formulations, scheme)(kin)))
    assert verdict.status == "PROVED"
    assert check_certificate(verdict.certificate).holds


def test_so_it_is_with_obstacle_rows():
    kin = kinematics("planar3")
    form = rr.formulations.clearance_rows(kin, contacts=(0, 2))
    assert settle(equilibrium_is_optimum(form)).status == "PROVED"
    kept = settle(clearance_is_kept(form, kin, (0, 2)))
    assert kept.status == "HOLDS_UNDER"
    wrong = settle(clearance_is_kept(form, kin, (2, 0)))
    assert wrong.status == "UNKNOWN"


def test_clearances_are_kept_at_the_rate_of_the_rows():
    kin = kinematics("planar3")
    form = rr.formulations.clearance_rows(kin, contacts=(0, 2), gamma=3.0, safe=0.1)
    proof = clearance_is_kept(form, kin, (0, 2))
    assert "-3 (d - 0.1)" in proof.claim.statement
    assert settle(proof).status == "HOLDS_UNDER"


def test_so_it_is_where_the_folded_hessian_is_rounded():
    form = rr.formulations.infinity_norm(kinematics("planar3"))
    assert settle(equilibrium_is_optimum(form)).status == "PROVED"


def test_a_claim_without_meaning_is_left_out():
    kin = kinematics("planar3")
    network = rr.networks.PrimalDual()
    loop = by_id(claims(rr.formulations.closed_loop(kin), network, kin))
    feedback = by_id(claims(rr.formulations.position_feedback(kin), network, kin))
    assert {"energy_decreases", "exponential_rate", "euler_step"} <= set(loop)
    assert not {"energy_decreases", "exponential_rate"} & set(feedback)
    assert "reduced_law_decreases" in feedback
    free = claims(rr.formulations.closed_loop(kin), rr.networks.DualNetwork(), kin)
    assert "equilibrium_is_optimum" not in by_id(free)


def test_the_rate_is_one_that_the_network_has():
    """Against eigenvalues of the network's own Jacobian, no bound active."""
    kin = kinematics("planar3")
    form = rr.formulations.minimum_velocity(kin)
    claim = exponential_rate(form, kin)
    for vertex in claim.vertices:
        modes = np.linalg.eigvals(np.array(vertex, dtype=float))
        assert np.max(modes.real) < -float(claim.rate)
    assert settle(claim).status == "HOLDS_UNDER"


@pytest.mark.parametrize("name", ["planar3", "panda"])
def test_limits_are_kept_on_every_robot(name):
    kin = kinematics(name)
    verdict = settle(limits_are_kept(rr.formulations.minimum_velocity(kin), kin))
    assert verdict.status == "HOLDS_UNDER"
    assert verdict.assumptions[0].endswith("q(0) lies within the limits")
    faster = rr.formulations.minimum_velocity(kin, c1=2.0, c2=0.6)
    assert settle(limits_are_kept(faster, kin)).status == "HOLDS_UNDER"


@pytest.mark.parametrize("side", ["lower", "upper"])
def test_bounds_that_lead_out_of_the_limits_are_refuted(side):
    kin = kinematics("planar3")
    form = rr.formulations.minimum_velocity(kin)
    out = {"lower": -1e-3, "upper": 1e-3}[side]
    careless = replace(form, **{side: getattr(form, side) + out})
    assert settle(limits_are_kept(careless, kin)).status == "REFUTED"


def test_claims_speak_of_the_scheme_as_it_was_made():
    kin, network = kinematics("planar3"), rr.networks.PrimalDual()
    other = rr.formulations.position_feedback(kin, c1=2.0)
    assert "reduced_law_decreases" not in by_id(claims(other, network, kin))
    with pytest.raises(RrnnError, match="other kinematics"):
        claims(other, network, kinematics("planar3"))


def test_exact_values_agree_with_casadi():
    kin = kinematics("pa10")
    form = rr.formulations.minimum_velocity(kin)
    function = form.function()
    rng = np.random.default_rng(0)
    point = {function.name_in(i): rng.standard_normal(function.numel_in(i)).tolist()
             for i in range(function.n_in())}  # fmt: skip
    point["q"] = [0] * 7
    found = exact_values(function, point)
    numbers = function.call({k: np.array(v) for k, v in point.items()})
    for k, values in enumerate(found):
        want = np.asarray(numbers[function.name_out(k)]).ravel(order="F")
        np.testing.assert_allclose([float(v) for v in values], want, atol=1e-12)
