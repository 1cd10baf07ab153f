"""What is in a network's graph, against what the network declares."""

from dataclasses import dataclass, replace
from functools import cache

import casadi as ca
import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.errors import RrnnError
from rrnn_opt.networks import LviPdnn, PrimalDual
from rrnn_opt.networks.inspection import (
    function_operations,
    graph_operations,
    opaque,
    own_operations,
)
from rrnn_opt.networks.network import ARITHMETIC
from tests.catalogue import Scheme, accepted, form, label, rules, schemes
from tests.networks.toy import WEIGHT, G, H, law, point, programme


@cache
def shapes(robot):
    """The schemes that differ in size, bounds or Hessian, which is all that counts."""
    found = {}
    for scheme in schemes():
        qp = form(robot, scheme).qp
        sides = tuple(x.is_constant() for x in ca.vertsplit(ca.vertcat(qp.lb, qp.ub)))
        key = (qp.A.shape, qp.G.shape, sides, qp.hessian.tobytes())
        found.setdefault(key, form(robot, scheme))
    return [*found.values()]


@pytest.mark.parametrize("rule", rules(), ids=label)
@pytest.mark.parametrize(
    ("robot", "stride"),
    [
        ("planar3", 4),
        pytest.param("planar3", 1, marks=pytest.mark.slow),
        pytest.param("pa10", 1, marks=pytest.mark.slow),
    ],
)
def test_a_network_adds_the_operations_that_it_declares_and_no_others(
    rule, robot, stride
):
    """A network that called an undeclared inverse would be a fake."""
    seen = set()
    for declared in shapes(robot)[::stride]:
        try:
            own = own_operations(rule, declared)
        except RrnnError as error:
            names_both(error, rule, declared)
            continue
        assert own <= rule.operations, f"{declared.name}: {own - rule.operations}"
        inverse = rule.needs(declared).inverse
        factored = "Cholesky" in inverse or "KKT" in inverse
        assert not factored or {"sqrt", "div"} <= own, declared.name
        seen |= own
    assert seen | ARITHMETIC == rule.operations | ARITHMETIC


def names_both(error, rule, declared):
    assert f"{type(rule).__name__}: {declared.name} " in str(error)


EVERY = [
    pytest.param(("planar3", (Scheme("method1", "contacts"), Scheme("method3")))),
    pytest.param(("planar3", schemes()), marks=pytest.mark.slow),
    pytest.param(("pa10", schemes()), marks=pytest.mark.slow),
]


@pytest.mark.parametrize("rule", rules(), ids=label)
@pytest.mark.parametrize("chosen", EVERY, ids=["planar3", "planar3-all", "pa10-all"])
def test_the_whole_graph_holds_what_network_and_scheme_hold(rule, chosen):
    for scheme, dynamics in accepted(chosen[0], rule, chosen[1]):
        of_scheme = function_operations(dynamics.formulation.qp.functions()["qp"])
        extra = graph_operations(dynamics.frozen) - rule.operations - of_scheme
        assert extra <= {"scale"}, f"{scheme}: {extra}"


@dataclass(frozen=True)
class Fake(PrimalDual):
    """(6) that divides by the Gram determinant of its rows, and does not say so."""

    def __call__(self, form):
        made = super().__call__(form)
        A = form.qp.A
        return replace(made, derivative=made.derivative / ca.det(A @ A.T))


def test_an_undeclared_inverse_is_found():
    own = own_operations(Fake(), programme())
    assert "div" in own - Fake().operations


def test_a_division_by_a_number_is_no_inverse():
    x = ca.SX.sym("x")
    for expr, found in ((x / 3, {"scale"}), (1 / x, {"div"}), (3 / x, {"div"})):
        assert function_operations(ca.Function("f", [x], [expr])) == found


def test_the_opaque_formulation_has_the_same_optimum_for_the_same_numbers():
    declared, given = programme(), point(4)
    hidden = opaque(declared)
    data = declared.qp.functions()["qp"].call([given["A"], given["b"]])
    names = dict(zip(("P", "q", "A", "b", "G", "h", "lb", "ub"), data, strict=True))
    told = {p.name: np.asarray(names[p.name[5:]]) for p in hidden.parameters}
    state = np.random.default_rng(0).normal(size=8)
    rule = LviPdnn()
    np.testing.assert_allclose(
        law(rule(hidden), state, told), law(rule(declared), state, given), atol=1e-12
    )


def test_sides_that_are_infinite_for_all_parameters_stay_so():
    u = rr.Symbol.vector("u", 2)
    half = rr.Formulation("half", u, (), cost=ca.sumsqr(u.sx), upper=ca.SX([1, ca.inf]))
    hidden = opaque(half)
    assert hidden.lower.is_constant()
    assert not hidden.upper[0].is_constant()
    assert float(hidden.upper[1]) == np.inf
    assert [p.name for p in hidden.parameters] == ["data_q", "data_lb", "data_ub"]


def test_rows_and_hessian_keep_their_shapes():
    hidden = opaque(programme())
    np.testing.assert_array_equal(hidden.qp.hessian, WEIGHT)
    assert hidden.qp.G.shape == G.shape
    assert hidden.qp.h.shape == (len(H), 1)
