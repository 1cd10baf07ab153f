import casadi as ca
import numpy as np
import pytest

from rrnn_opt.emit.operations import C_TEXT
from rrnn_opt.errors import RrnnError, UnsupportedOperationError
from rrnn_opt.symbolic.interpreter import NUMPY
from rrnn_opt.symbolic.tape import OPERATIONS, Tape, fingerprint

X = ca.SX.sym("x", 3)
Y = ca.SX.sym("y", 2, 2)


def function(*results, name="f", names=None):
    outs = [f"out{k}" for k in range(len(results))]
    return ca.Function(name, [X, Y], list(results), names or ["x", "y"], outs)


def ops(tape):
    return [step.op for step in tape.instructions]


def test_a_small_graph_is_read_as_written():
    tape = Tape.of(function(X[0] * X[1] + 2.5))
    assert ops(tape) == ["input", "input", "mul", "const", "add", "output"]
    assert [step.out for step in tape.instructions] == [0, 1, 2, 3, 4, -1]
    assert tape.instructions[2].args == (0, 1)
    assert tape.instructions[3].const == 2.5
    assert tape.instructions[1].slot == (0, 1)
    assert tape.n_values == 5
    assert [port.shape for port in tape.inputs] == [(3, 1), (2, 2)]


def test_values_are_assigned_once_and_before_use():
    expr = X
    for _ in range(20):  # enough steps for work registers to be reused
        expr = ca.sin(expr) * X + ca.fmax(expr, 0.1)
    tape = Tape.of(function(expr))
    for k, step in enumerate(tape.instructions[: tape.n_values]):
        assert step.out == k
        assert all(arg < k for arg in step.args)
        assert len(step.args) == OPERATIONS[step.op].arity


def test_equal_subexpressions_are_one_value():
    first, second = ca.sin(X[0] * X[1]), ca.sin(X[1] * X[0])
    assert ops(Tape.of(function(first + second))).count("sin") == 1
    ordered = Tape.of(function((X[0] - X[1]) * (X[1] - X[0])))
    assert ops(ordered).count("sub") == 2


def test_dead_code_and_unused_inputs_are_dropped():
    tape = Tape.of(function(X[0] * 2))
    assert ops(tape).count("input") == 1
    assert tape.inputs[1].name == "y"


def test_slots_count_dense_elements_of_sparse_matrices():
    sparse = ca.SX.sym("s", ca.Sparsity.lower(3))
    fn = ca.Function(
        "f", [sparse], [ca.SX.eye(2) * sparse[2, 2], sparse], ["s"], ["e", "s_"]
    )
    tape = Tape.of(fn)
    read = {step.slot[1] for step in tape.instructions if step.op == "input"}
    assert read == {0, 1, 2, 4, 5, 8}
    written = {step.slot for step in tape.instructions if step.op == "output"}
    assert {slot[1] for slot in written if slot[0] == 0} == {0, 3}


def test_an_mx_function_is_expanded():
    x = ca.MX.sym("x", 3)
    tape = Tape.of(ca.Function("f", [x], [ca.norm_2(x)], ["x"], ["n"]))
    assert ops(tape)[-2:] == ["sqrt", "output"]


def test_free_variables_and_unknown_operations_are_refused():
    with pytest.raises(RrnnError, match="free variables"):
        Tape.of(ca.Function("f", [X], [X + ca.SX.sym("p")], {"allow_free": True}))
    with pytest.raises(UnsupportedOperationError, match="instruction tape"):
        Tape.of(function(ca.erf(X)))


def test_the_fingerprint_sees_all_that_matters_and_nothing_else():
    base = fingerprint(function(0.1 * X))
    assert base == fingerprint(function(0.1 * X, name="g"))
    assert base == fingerprint(function(X * 0.1))
    assert len(base) == 64
    other = [
        function(np.nextafter(0.1, 1) * X),
        function(0.1 * X, names=["x", "z"]),
        function(0.1 * X[::-1]),
        function((0.1 * X).T),
        function(0.1 * X, X),
        ca.Function("f", [X], [0.1 * X], ["x"], ["out0"]),
        ca.Function("f", [X, Y], [0.1 * X], ["x", "y"], ["out"]),
    ]
    assert len({base, *(fingerprint(fn) for fn in other)}) == len(other) + 1


def test_every_reader_covers_the_one_table():
    computed = set(OPERATIONS) - {"input", "output", "const"}
    assert set(NUMPY) == computed
    assert set(C_TEXT) | {"sin", "cos"} == computed
