"""The longest step is proved, is kept by the network, and is not far from the edge."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.check.claims.certificate import check_certificate
from rrnn_opt.dynamics import Euler
from rrnn_opt.embedding import generate
from rrnn_opt.embedding.step_bound import longest_step
from rrnn_opt.embedding.step_claim import SafeStep
from rrnn_opt.errors import RrnnError
from rrnn_opt.formulations.known_obstacles import row_bound, with_obstacles

RULE = rr.networks.LviPdnn(whiten=True)


@pytest.fixture(scope="module")
def arm():
    kin = rr.Kinematics(rr.Robot.builtin("panda"))
    wanted = {"points": [20, 55], "obstacles": 1}
    form = with_obstacles(rr.formulations.minimum_velocity(kin), kin, **wanted)
    return kin, form, row_bound(kin, **wanted)


@pytest.mark.parametrize("size", [(2, 1, 1.0), (7, 3, 1.0), (7, 5, 5.5)])
def test_the_step_is_proved_and_a_longer_one_is_not(size):
    safe = SafeStep.of(*size)
    verdict = safe.proof().settle()
    assert verdict.status == "HOLDS_UNDER"
    assert {a[:2] for a in verdict.assumptions} == {"A1", "A2", "pe"}
    longer = replace(safe, tau=safe.tau + Fraction(1, 64))
    assert longer.proof().settle().status not in ("PROVED", "HOLDS_UNDER")


def test_it_is_the_bound_of_the_network(arm):
    """Within one per cent of 2 / (gamma |I + H|^2) where the rows are orthonormal."""
    kin, _, _ = arm
    form = rr.formulations.minimum_velocity(kin)
    found = longest_step(RULE, form, None)
    q = np.array([0.0, 0.3, 0.0, -1.9, 0.0, 2.2, 0.8])
    told = RULE.euler_bound(form, q=q, rd_dot=np.zeros(3))
    assert found <= told
    assert found == pytest.approx(told, rel=0.01)
    plain = rr.networks.LviPdnn()
    assert longest_step(plain, form, None) is None
    assert longest_step(rr.networks.PrimalDual(whiten=True), form, None) is None


def test_no_step_goes_away_from_a_solution(arm):
    _, form, norm = arm
    h = longest_step(RULE, form, norm)
    law = RULE(form)
    step = law.step(Euler(h)).functions()["step"]
    rng = np.random.default_rng(2)
    settled = 0
    for _ in range(3):
        q = np.array([0.0, 0.3, 0.0, -1.9, 0.0, 2.2, 0.8]) + rng.uniform(-0.3, 0.3, 7)
        given = q, 0.1 * rng.normal(size=3), np.array([0.6, 0.1, 0.4, 0.1])
        state = rng.normal(size=law.state.size)
        way = [state]
        for _ in range(1500):
            way.append(np.asarray(step(way[-1], *given)[0]).ravel())
        residual = law.functions()["residual"](way[-1], *given)
        if np.abs(np.asarray(residual)).max() > 1e-9:
            continue
        settled += 1
        away = np.linalg.norm(np.array(way) - way[-1], axis=1)
        assert np.all(np.diff(away) <= 1e-9)
    assert settled > 0


def test_the_bound_of_the_rows_is_one(arm):
    kin, form, norm = arm
    found, limits = form.qp.functions()["qp"], kin.robot.limits
    rng = np.random.default_rng(0)
    for _ in range(200):
        q = rng.uniform(limits.lower, limits.upper)
        sphere = np.append(rng.uniform(-1, 1, 3), 0.1)
        G = np.asarray(found(q, np.zeros(3), sphere)[4])
        assert np.linalg.norm(G, 2) <= norm


def test_the_manifest_names_it_and_its_certificate_holds(arm):
    kin, form, norm = arm
    package = generate(RULE(form), network=RULE, kinematics=kin, row_norm=norm)
    (row,) = package.manifest["claims"]
    assert row["verdict"] == "HOLDS_UNDER"
    document = json.loads(package.files[row["certificate"]])
    assert check_certificate(document).status == "HOLDS_UNDER"
    longest = package.manifest["discretisation"]["longest_step_s"]
    assert f"{longest * RULE.gamma:.6f}"[:6] in row["statement"]
    again = generate(RULE(form), network=RULE, kinematics=kin, row_norm=norm)
    assert again.files == package.files
    with pytest.raises(RrnnError, match="safe"):
        generate(RULE(form), network=RULE, row_norm=norm, step_size=1.1 * longest)
    assert generate(RULE(form)).manifest["claims"] == []
