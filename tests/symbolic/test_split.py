import casadi as ca
import numpy as np
import pytest

from rrnn_opt.errors import RrnnError
from rrnn_opt.symbolic.interpreter import evaluate
from rrnn_opt.symbolic.split import WORK, only, split
from rrnn_opt.symbolic.tape import Tape


def whole():
    x, p, h = ca.SX.sym("x", 2), ca.SX.sym("p", 3), ca.SX.sym("h")
    heavy = ca.sin(p[0]) * ca.cos(p[1]) + ca.sqrt(p[2])
    outputs = [x + h * (heavy * x + p[:2]), heavy + p, ca.dot(x, x) + 2.0]
    names = ["next", "early", "size"]
    return ca.Function("f", [x, p, h], outputs, ["x", "p", "h"], names)


def test_both_parts_together_are_the_whole():
    fn = whole()
    first, second = split(Tape.of(fn), late=(0, 2), early_results=(1,))
    assert [port.name for port in first.inputs] == ["p"]
    assert [port.name for port in second.inputs] == ["x", "h", WORK]
    assert "sin" not in second.operations
    x, p, h = np.array([0.3, -0.7]), np.array([0.2, 1.1, 0.9]), np.array([0.05])
    early, passed = evaluate(first, [p])
    after, size = evaluate(second, [x, h, passed])
    wanted = evaluate(Tape.of(fn), [x, p, h])
    for got, want in zip((after, early, size), wanted, strict=True):
        np.testing.assert_array_equal(got, want)
    (alone,) = evaluate(only(second, (1,)), [x, h, passed])
    np.testing.assert_array_equal(alone, size)
    assert only(second, (1,)).n_values < second.n_values


def test_an_early_result_must_not_depend_on_what_comes_later():
    with pytest.raises(RrnnError, match="early result depends"):
        split(Tape.of(whole()), late=(0, 2), early_results=(0,))
