"""Certified regions against samples, simulation and the known truth of the arm."""

from __future__ import annotations

import json

import casadi as ca
import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.check.claims.document import read_claim
from rrnn_opt.check.claims.graph.polynomial import normal_forms
from rrnn_opt.claim import Claim, Relation
from rrnn_opt.errors import DocumentError, RrnnError, ShapeError
from rrnn_opt.report import draw_region
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification.document import claim_block
from rrnn_opt.verification.region.cell import Tools, slack
from rrnn_opt.verification.region.reduced import ReducedArm
from rrnn_opt.verification.region.singular import SingularBound

EPSILON, ERROR = 0.1, 0.1


@pytest.fixture(scope="module")
def planar() -> rr.Kinematics:
    return rr.Kinematics(rr.Robot.builtin("planar3"))


@pytest.fixture(scope="module")
def region() -> rr.Region:
    return rr.Region((0.3, 1.3, 1.4), (0.4, 0.5, 0.5))


@pytest.fixture(scope="module")
def found(planar, region):
    return rr.certify_region(
        planar,
        region,
        epsilon=EPSILON,
        error=ERROR,
        grid=(3, 3),
        budget_s=300.0,
        jobs=1,
    )


def jacobians(kin: rr.Kinematics, points: np.ndarray) -> np.ndarray:
    function = ca.Function("J", [kin.q], [kin.jacobian()])
    full = np.asarray(function.map(len(points))(points.T))
    stack = full.reshape(3, len(points), -1).transpose(1, 0, 2)
    return stack[:, [i for i in range(3) if not kin.jacobian()[i, :].is_zero()]]


def test_no_sample_is_below_a_certified_singular_value():
    rng = np.random.default_rng(0)
    kin = rr.Kinematics(rr.Robot.builtin("planar3"))
    arm = ReducedArm.of(kin)
    centre = rng.uniform(-2.5, 2.5, (len(arm.joints), 4000))
    half = rng.choice([0.3, 0.1, 0.01], centre.shape)
    least = SingularBound.of(arm)(centre - half, centre + half).least
    points = rng.uniform(-2.5, 2.5, (4000, kin.robot.nv))
    points[:, list(arm.joints)] = (centre + half * rng.uniform(-1, 1, half.shape)).T
    true = np.linalg.svd(jacobians(kin, points), compute_uv=False)[:, -1]
    assert np.all(true >= least)
    assert np.mean(least > 0.5 * true) > 0.2


def test_turning_the_whole_arm_changes_no_singular_value(planar):
    """An identity, not a sample: trace and determinant of J J' do not move."""
    J = planar.jacobian()[:2, :]
    q = planar.q
    still = ca.substitute(J, q, ca.vertcat(0, q[1], q[2]))
    parts = [ca.trace(A @ A.T) for A in (J, still)] + [
        ca.det(A @ A.T) for A in (J, still)
    ]
    difference = ca.vertcat(parts[0] - parts[1], parts[2] - parts[3])
    symbol = Symbol("q", q, "rad", "joints")
    claim = Claim("turn", "", "", (symbol,), Relation(difference, "==0"))
    forms = normal_forms(read_claim(claim_block(claim)))
    assert all(form == 0 for form in forms.results.values())
    assert ReducedArm.of(planar).turned == 0


def test_region_is_certified_whole(found):
    assert found.share == 1.0
    assert found.sigma > 0.4
    assert min(found.rate, found.step) > 0.0
    assert all(cell.residue is None for cell in found.cells)


def test_rate_and_step_hold_along_samples(planar, region, found):
    rng = np.random.default_rng(1)
    limits = planar.robot.limits
    for cell in found.cells:
        low, high = region.lower, region.upper
        for k, joint in enumerate(found.joints):
            low[joint], high[joint] = cell.lower[k], cell.upper[k]
        points = rng.uniform(low, high, (300, 3))
        angle, size = rng.uniform(-np.pi, np.pi, 300), ERROR * rng.random(300) ** 0.5
        e = size[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        J = jacobians(planar, points)
        drive = np.einsum("bij,bi->bj", J, e) / EPSILON
        lower = np.maximum(-limits.velocity, -0.5 * (points - limits.lower))
        upper = np.minimum(limits.velocity, 0.5 * (limits.upper - points))
        velocity = np.clip(drive, lower, upper)
        V = 0.5 * np.sum(e * e, axis=1)
        rate = -np.einsum("bi,bij,bj->b", e, J, velocity)
        assert np.all(rate <= -cell.rate * V * (1 - 1e-9))
        position = ca.Function("f", [planar.q], [planar.position()[:2]])
        moved = points + cell.step * velocity
        inside = np.all((moved >= low) & (moved <= high), axis=1)
        before = np.asarray(position.map(300)(points.T)).T
        after = np.asarray(position.map(300)(moved.T)).T
        left = e - (after - before)
        grown = 0.5 * np.sum(left**2, axis=1) - V
        assert np.all(grown[inside] <= 1e-12)


def test_singular_part_is_left_open(planar):
    """The straight arm is singular: no bound may be given for a box around it."""
    region = rr.Region((0.0, 0.0, 0.0), (0.1, 0.2, 0.2))
    found = rr.certify_region(
        planar, region, epsilon=EPSILON, grid=(3, 3), budget_s=0.5, jobs=1
    )
    assert found.share < 1.0
    middle = found.cells[4]
    assert middle.residue is not None
    assert middle.share < 1.0


def test_velocity_bounds_shrink_towards_the_limits(planar):
    limits = planar.robot.limits
    assert slack(limits, 0.5, np.zeros(3), np.zeros(3)) == pytest.approx(1.45)
    beyond = np.array([3.0, 0.0, 0.0])
    assert slack(limits, 0.5, np.zeros(3), beyond) < 0.0


def test_given_delta_is_an_assumption(planar, region):
    found = rr.certify_region(
        planar, region, epsilon=EPSILON, delta=0.25, grid=(1, 1), budget_s=5.0
    )
    assert found.cells[0].delta == 0.25
    assert any("0.25" in text for text in found.assumptions)


def test_bad_input_is_refused(planar):
    with pytest.raises(ShapeError):
        rr.certify_region(planar, rr.Region((0.0,), (0.1,)), epsilon=0.1)
    with pytest.raises(RrnnError, match="positive"):
        rr.certify_region(planar, rr.Region((0.0,) * 3, (0.1,) * 3), epsilon=-1.0)
    with pytest.raises(RrnnError):
        rr.Region((0.0, np.nan), (0.1, 0.1))
    for bad in ({"delta": 0.0}, {"gain": -1.0}, {"error": 0.0}, {"grid": (0, 1)}):
        with pytest.raises(RrnnError, match="positive"):
            rr.certify_region(planar, **{"epsilon": 0.1} | bad)
    with pytest.raises(RrnnError, match="0 to 2"):
        rr.certify_region(planar, epsilon=0.1, joints=(0, 3))


def test_map_is_written_and_drawn(found, tmp_path):
    document = json.loads(json.dumps(found.to_dict()))
    path = draw_region(document, tmp_path / "map.png")
    assert path.read_bytes().startswith(b"\x89PNG")
    with pytest.raises(DocumentError):
        draw_region({"kind": "something else"}, tmp_path / "other.png")


@pytest.mark.slow
def test_pa10_working_region_is_certified():
    kin = rr.Kinematics(rr.Robot.builtin("pa10"))
    region = rr.Region.working(kin, half_width=0.2)
    found = rr.certify_region(kin, region, epsilon=EPSILON, grid=(4, 4), budget_s=300.0)
    assert found.share == 1.0
    assert found.sigma > 0.1
    rng = np.random.default_rng(2)
    points = rng.uniform(region.lower, region.upper, (2000, 7))
    true = np.linalg.svd(jacobians(kin, points), compute_uv=False)[:, -1]
    assert true.min() >= found.sigma
    assert Tools.of(kin, None).arm.joints == (1, 2, 3, 4, 5)
