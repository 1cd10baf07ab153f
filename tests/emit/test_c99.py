import re
import subprocess

import casadi as ca
import numpy as np
import pytest

from rrnn_opt import emit
from rrnn_opt.emit.c99 import literal, parameter_names
from rrnn_opt.emit.compiler import _ask, _zig
from rrnn_opt.errors import RrnnError, UnsupportedOperationError
from rrnn_opt.symbolic.tape import Instruction, Port, Tape

WARNINGS = """-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion
    -Wfloat-conversion -Wmissing-prototypes -Werror"""
STRICT = ["-std=c99", "-O2", "-ffp-contract=off", "-c", *re.findall(r"\S+", WARNINGS)]
Q = ca.SX.sym("q", 3)


def function(result, names=("q", "y")):
    return ca.Function("f", [Q], [result], [names[0]], [names[1]])


def text(result, real="double"):
    return emit.c_function(function(result), "arm_f", real=real)


def commands():
    zig = (*_zig(), *([] if _zig() else ["zig"]))
    return [("gcc",), ("clang",), zig]


def unit(functions, real):
    parts = [emit.prologue(real)]
    for fn in functions:
        parts.append(emit.c_function(fn, f"my_{fn.name()}", real=real, static=False))
    return "\n".join(parts)


@pytest.mark.parametrize("real", ["double", "float"])
@pytest.mark.parametrize("which", [0, 1, pytest.param(2, marks=pytest.mark.slow)])
def test_no_compiler_finds_anything_to_warn_about(
    which, real, wild_functions, tame_functions, tmp_path
):
    command = commands()[which]
    if _ask(command, None) is None:
        pytest.skip(f"{('gcc', 'clang', 'ziglang')[which]} is not installed")
    source = tmp_path / "unit.c"
    source.write_text(unit([*wild_functions[:15], *tame_functions[:15]], real))
    done = subprocess.run(
        [*command, *STRICT, str(source), "-o", str(tmp_path / "unit.o")],
        check=False,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr


def test_float_text_holds_nothing_double(wild_functions, tame_functions):
    source = unit([*wild_functions, *tame_functions], "float")
    code = re.sub(r"/\*.*?\*/", "", source, flags=re.DOTALL)
    code = "\n".join(line for line in code.splitlines() if not line.startswith("#"))
    assert not re.search(r"\bdouble\b", code)
    number = r"(?<![\w.])(?:0x[\da-f.]+p[+-]\d+|\d+\.\d*(?:e[+-]?\d+)?)"
    literals = re.findall(number + r"\w*", code)
    assert len(literals) > 100
    assert all(item.endswith("F") for item in literals)
    calls = set(re.findall(r"\b(\w+)\(", code))
    maths = {"sqrt", "fabs", "floor", "ceil", "copysign", "exp", "tan", "atan2"}
    assert not calls & maths
    assert {"sqrtf", "atan2f", "fabsf"} <= calls


def test_sine_and_cosine_of_one_argument_are_one_call():
    code = text(ca.vertcat(ca.sin(Q[0]), ca.cos(Q[0]), ca.cos(Q[1])))
    assert code.count("= rrnn_sincos(") == 2
    assert "math.h" not in code


def test_locals_are_constant_and_assigned_once():
    code = text(ca.sin(Q) * Q + 0.1)
    names = re.findall(r"const (?:real_t|rrnn_sincos_t) (\w+) = ", code)
    assert len(names) == len(set(names)) > 6
    assigned = re.findall(r"^    (?!const|y\[)(.*)$", code, re.MULTILINE)
    assert assigned == []


def test_structural_zeros_are_written():
    code = emit.c_function(function(ca.SX.eye(2) * Q[0]), "arm_f")
    assert "real_t y[4]" in code
    assert code.count("= 0.0;") == 2


def test_the_comment_lists_library_functions():
    assert "library functions: atan2, exp */" in text(ca.exp(ca.atan2(Q[0], Q[1])))
    assert "library functions: none */" in text(ca.sqrt(Q))


def test_static_and_exported_signatures():
    fn = function(Q)
    assert "static void a_f(const real_t q[3], real_t y[3])" in emit.c_function(
        fn, "a_f"
    )
    exported = emit.c_function(fn, "a_f", static=False)
    assert "RRNN_EXPORT void a_f(const real_t q[3], real_t y[3]);" in exported
    assert "static" not in exported


def test_names_are_made_legal_and_unique():
    ports = [Port(n, (1, 1)) for n in ("double", "t1", "p12", "sqrt", "q", "expf")]
    results = [Port(n, (1, 1)) for n in ("q", "y", "y_")]
    names = parameter_names(Tape("f", tuple(ports), tuple(results), (), 0))
    assert names == ["double_", "t1_", "p12_", "sqrt_", "q", "expf_", "q_", "y", "y_"]


@pytest.mark.parametrize("name", ["2f", "a-b", "int", "", "größe"])
def test_bad_function_names_are_refused(name):
    with pytest.raises(RrnnError, match="identifier"):
        emit.c_function(function(Q), name)


def test_operations_without_c_text_are_refused():
    step = Instruction("erf", 0)
    with pytest.raises(UnsupportedOperationError, match="C99 emitter: operation 'erf'"):
        emit.c_function(Tape("f", (), (), (step,), 1), "f")


def test_literals_are_exact():
    rng = np.random.default_rng(0)
    for value in [*rng.normal(size=50), 1e-310, 1e308, 5.0, 0.0, 1e22]:
        assert float(literal(value).strip("()")) == value
        narrow = literal(value, "float").strip("()")
        if np.abs(value) < 1e38:
            assert narrow.endswith("F")
            assert np.float32(narrow[:-1]) == np.float32(value)
    assert literal(-2.0) == "(-2.0)"
    assert literal(np.inf) == "(real_t)INFINITY"
    assert literal(1e300, "float") == "(real_t)INFINITY"
    assert literal(-np.inf, "float") == "(-(real_t)INFINITY)"
    assert literal(np.nan) == "(real_t)NAN"


def test_results_may_overwrite_arguments():
    program = emit.compile(function(ca.vertcat(Q[2], Q[0] + Q[1], Q[0])), name="alias")
    q = np.array([1.0, 2.0, 4.0])
    program.call("f", q, out=(q,))
    np.testing.assert_array_equal(q, [4.0, 3.0, 1.0])


@pytest.mark.parametrize(("real", "suffix"), [("double", ""), ("float", "f")])
@pytest.mark.parametrize("trig", ["own", "libm"])
def test_the_library_is_called_in_the_type_of_the_numbers(real, suffix, trig):
    """A ``sqrt`` among floats has the same value and is software on a Cortex-M4F."""
    head = re.sub(r"/\*.*?\*/", "", emit.prologue(real, trig=trig), flags=re.DOTALL)
    called = re.findall(r"\b(sqrt|fabs|sin|cos|floor|rint)(f?)\(", head)
    assert {name for name, _ in called} >= {"sqrt", "fabs"}
    assert {ending for _, ending in called} == {suffix}
