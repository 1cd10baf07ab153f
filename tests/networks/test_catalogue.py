"""Laws that every exported network must keep on every scheme it does not refuse.

The default selection takes two schemes of the planar arm that hold every kind of
row; the slow one half of all schemes on that arm and a sixth on PA10, other ones for
each network. (Every pair settles on PA10 in the study of the ground truth.)
"""

import casadi as ca
import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt import emit
from tests.catalogue import (
    ROBOTS,
    Scheme,
    accepted,
    kinematics,
    label,
    points,
    rules,
    schemes,
)

QUICK = ("planar3", (Scheme("method1", "contacts"), Scheme("method3")), 1)
"""All kinds of rows with bounds; equality rows alone."""

MANY = [
    pytest.param((robot, schemes(), stride), id=f"{robot}-many", marks=pytest.mark.slow)
    for robot, stride in (("planar3", 2), ("pa10", 6))
]


@pytest.fixture(params=rules(), ids=label)
def rule(request):
    return request.param


def chosen(request, rule):
    robot, selection, stride = request.param
    part = selection[rules().index(rule) % stride :: stride]
    found = accepted(robot, rule, part) or accepted(robot, rule, selection)
    assert found
    return robot, found


@pytest.fixture(params=[pytest.param(QUICK, id=QUICK[0]), *MANY])
def pairs(request, rule):
    return chosen(request, rule)


def arrays(law, given):
    return [given[p.name] for p in law.parameters]


def function(law, *parts):
    symbols = [law.state.sx, *(p.sx for p in law.parameters)]
    return ca.Function("f", symbols, [ca.densify(part) for part in parts])


def test_it_is_as_large_as_it_says(rule, pairs):
    for scheme, law in pairs[1]:
        needs = rule.needs(law.formulation)
        assert needs.state == law.state.size, f"{scheme}"
        assert needs.duals <= needs.state
        assert needs.rates is bool(law.rates)


def test_its_equilibrium_reads_as_the_solvers_optimum(rule, pairs):
    """Some state has the solver's x and multipliers as its reading, and rests."""
    robot, found = pairs
    for scheme, law in found:
        still = law.frozen
        reading = [still.output, *still.multipliers.values(), still.residual]
        stack = ca.vertcat(*reading)
        fn = function(still, stack, ca.jacobian(stack, still.state.sx), still.start)
        for point in points(robot, scheme)[:6]:
            wanted = {"lam": point.lam, "mu": point.mu, "z_box": point.box}
            target = [point.x, *(wanted[name] for name in still.multipliers)]
            target = np.concatenate([*target, np.zeros(still.state.size)])
            inputs = arrays(still, point.given)
            state = np.asarray(fn(np.zeros(still.state.size), *inputs)[2]).ravel()
            for _ in range(6):
                value, slope, _ = fn(state, *inputs)
                gap = target - np.asarray(value).ravel()
                state = state + np.linalg.lstsq(np.asarray(slope), gap, rcond=1e-12)[0]
            gap = target - np.asarray(fn(state, *inputs)[0]).ravel()
            assert np.abs(gap).max() < 1e-6, f"{scheme}: {np.abs(gap).max()}"


def test_it_settles_at_the_solvers_optimum(rule, pairs):
    """And where it does not, it says so: no answer is ever wrong."""
    robot, found = pairs
    mild = active = total = 0
    for scheme, law in found:
        for point in points(robot, scheme):
            x, info = rr.settle(law, **point.given)
            total, mild = total + 1, mild + point.mild
            active += point.active
            if x is None:
                assert not point.mild, f"{scheme}: {info.status}"
                continue
            agrees(scheme, point, x, info)
    assert mild > total / 4
    assert active > total / 20 or not any(s.formulation.qp.bounded for _, s in found)


def agrees(scheme, point, x, info):
    """To 1e-6 and 1e-5 where the point is mild, else by the KKT residual."""
    if not point.mild:
        assert info.kkt_residual <= 1e-5, f"{scheme}"
        np.testing.assert_allclose(x, point.x, atol=1e-3, err_msg=f"{scheme}")
        return
    np.testing.assert_allclose(x, point.x, atol=1e-6, err_msg=f"{scheme}")
    duals = {"equality": point.lam, "inequality": point.mu, "box": point.box}
    for name, want in duals.items() if point.unique else ():
        where = f"{scheme}: {name}"
        np.testing.assert_allclose(info.duals[name], want, atol=1e-5, err_msg=where)


def law_of(law):
    return law.derivative if hasattr(law, "derivative") else law.next


def random_inputs(robot, scheme, law, seed):
    rng = np.random.default_rng(seed)
    given = dict(points(robot, scheme)[seed].given)
    for symbol in law.rates.values():
        given[symbol.name] = rng.normal(size=symbol.shape) / 10
    return [rng.normal(size=law.state.size), *arrays(law, given)]


def test_compiled_c_is_casadi_s_law(rule, pairs):
    robot, found = pairs
    named = {}
    for k, (_, law) in enumerate(found):
        fn = function(law, law_of(law), law.output)
        names = [law.state.name, *(p.name for p in law.parameters)]
        outputs = ["law_out", "output_out"]
        named[f"law{k}"] = ca.Function(
            f"law{k}", fn.sx_in(), fn(*fn.sx_in()), names, outputs
        )
    program = emit.compile([*named.values()], name="laws")
    for k, (scheme, law) in enumerate(found):
        for seed in range(3):
            inputs = random_inputs(robot, scheme, law, seed)
            flat = [np.asfortranarray(i) for i in inputs]
            ours = program.call(f"law{k}", *flat)
            theirs = named[f"law{k}"](*inputs)
            for mine, other in zip(ours, theirs, strict=True):
                other = np.asarray(other).reshape(mine.shape)
                scale = 1.0 + np.abs(other).max()
                assert np.abs(mine - other).max() <= 1e-12 * scale, f"{scheme}"


def test_the_slope_of_its_residual_against_finite_differences(rule, pairs):
    """What Newton's method and the choice of the step rely on."""
    robot, found = pairs
    for scheme, law in found:
        slope = function(law, ca.jacobian(law.residual, law.state.sx))
        residual = function(law, law.residual)
        state, *rest = random_inputs(robot, scheme, law, 4)
        exact = np.asarray(slope(state, *rest))
        for i, h in enumerate(1e-7 * np.eye(state.size)):
            rise = residual(state + h, *rest) - residual(state - h, *rest)
            gap = np.asarray(rise).ravel() / 2e-7 - exact[:, i]
            scale = 1.0 + np.abs(exact[:, i]).max()  # P^-1 may be large
            assert np.abs(gap).max() < 1e-5 * scale, f"{scheme}"


def test_told_the_rates_its_error_obeys_its_law_while_all_data_move(rule, pairs):
    """Central differences of the residual along the network and its data."""
    robot, found = pairs
    for scheme, law in found:
        if not law.rates:
            continue
        state, *rest = random_inputs(robot, scheme, law, 2)
        state = abs(state)  # a gain is positive
        given = dict(zip((p.name for p in law.parameters), rest, strict=True))
        derivative, residual = function(law, law_of(law)), function(law, law.residual)
        slope, h = np.asarray(derivative(state, *rest)).ravel(), 1e-6
        sides = []
        for sign in (1.0, -1.0):
            moved = dict(given)
            for name, rate in law.rates.items():
                moved[name] = given[name] + sign * h * given[rate.name]
            ahead = residual(state + sign * h * slope, *moved.values())
            sides.append(np.asarray(ahead).ravel())
        size = law.formulation.decision.size + law.formulation.equalities.size1()
        measured = (sides[0] - sides[1])[:size] / (2 * h)
        # the same law where nothing moves: there d error/dt = Phi y' exactly
        still = law.frozen
        frozen = function(
            still, law_of(still), ca.jacobian(still.residual, still.state.sx)
        )
        fixed = [given[p.name] for p in still.parameters]
        rate, turn = (np.asarray(v) for v in frozen(state, *fixed))
        wanted = (turn @ rate.ravel())[:size]
        asked = np.abs(turn[:size]).max(axis=1) > 0.0  # a planar arm has no z row
        scale = 1.0 + np.abs(wanted).max()
        assert np.abs(measured - wanted)[asked].max() < 1e-5 * scale, f"{scheme}"


def test_every_robot_of_the_list_is_there():
    assert {kinematics(robot).robot.name for robot in ROBOTS} == set(ROBOTS)
    assert len(rules()) >= 11
    assert len(schemes()) >= 20
