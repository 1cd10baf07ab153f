"""The package compiles without a warning and computes what CasADi computes."""

from __future__ import annotations

import ctypes
import shutil
import subprocess

import numpy as np
import pytest

from rrnn_opt.dynamics import Euler, NeuralDynamics
from rrnn_opt.embedding import generate
from rrnn_opt.symbolic import Symbol

C_TYPE = {"double": ctypes.c_double, "float": ctypes.c_float}
TOLERANCE = {"double": 1e-12, "float": 1e-4}


def run(*call):
    return subprocess.run(call, capture_output=True, text=True, check=False, timeout=60)


def structs(dynamics, real):
    """The structs of the header, written down a second time."""
    number = C_TYPE[real]

    def struct(fields):
        return type("S", (ctypes.Structure,), {"_fields_": fields})

    n, m = dynamics.state.size, dynamics.output.numel()
    param = [("h", number), ("tolerance", number)]
    state = [("x", number * n), *param, ("merit", number), ("tick", ctypes.c_uint32)]
    inputs = [(p.name, number * p.size) for p in dynamics.parameters]
    out = [("output", number * m), ("residual", number), ("merit", number)]
    out += [("change", number), ("verdict", ctypes.c_uint32)]
    out += [("iterations", ctypes.c_uint32)]
    return struct(state), struct(inputs), struct(out), struct(param)


def host_test(cc, folder):
    """The package's own test, compiled."""
    sources = [*sorted((folder / "src").glob("*.c")), folder / "test/test_host.c"]
    includes = [folder / "include", folder / "src", folder / "test"]
    return cc(sources, "test_host", includes=includes)


@pytest.mark.parametrize(
    ("name", "real", "steps"),
    [("box", "double", 1), ("box", "float", 5), ("rows", "double", 5),
     ("rows", "float", 1)],
)  # fmt: skip
def test_steps_are_those_of_the_dynamics(networks, shared, tmp_path, name, real, steps):
    dynamics = networks[name]
    package = generate(dynamics, prefix="arm", real=real, steps=steps)
    folder = package.write(tmp_path)
    lib = shared(folder)
    State, In, Out, Param = structs(dynamics, real)
    state, out, number = State(), Out(), C_TYPE[real]
    h = number(0.004).value
    assert lib.arm_init(ctypes.byref(state), ctypes.byref(Param(h, 1e9))) == 0
    assert list(state.x) == [0.0] * dynamics.state.size
    oracle = dynamics.step(Euler(h)).functions()["step"]
    residual = dynamics.functions()["residual"]
    near = {"rtol": TOLERANCE[real], "atol": TOLERANCE[real]}
    rng, x = np.random.default_rng(5), np.zeros(dynamics.state.size)
    for tick in range(20):
        drawn = [0.4 * rng.standard_normal(p.size) for p in dynamics.parameters]
        given = In(*[(number * len(v))(*v) for v in drawn])
        exact = [np.array(list(getattr(given, p.name))) for p in dynamics.parameters]
        assert lib.arm_step(*(ctypes.byref(part) for part in (state, given, out))) == 0
        for _ in range(steps):
            last = np.max(np.abs(np.asarray(residual(x, *exact))))
            x = np.asarray(oracle(x, *exact)[0]).ravel()
        want = np.asarray(oracle(x, *exact)[1]).ravel()
        np.testing.assert_allclose(list(state.x), x, **near)
        np.testing.assert_allclose(list(out.output), want, **near)
        assert out.residual == pytest.approx(last, rel=1e-3, abs=1e-4)
        assert state.tick == tick + 1
        x = np.array(list(state.x))  # so that rounding does not pile up
    lib.arm_model_hash.restype = ctypes.c_char_p
    assert lib.arm_model_hash().decode() == package.manifest["model_hash"]


@pytest.mark.parametrize("real", ["double", "float"])
def test_refusals_leave_everything_as_it_was(networks, shared, tmp_path, real):
    dynamics = networks["box"]
    folder = generate(dynamics, real=real).write(tmp_path)
    lib = shared(folder)
    State, In, Out, Param = structs(dynamics, real)
    number = C_TYPE[real]
    state, out = State(), Out()
    for h, status in ((0.0, 2), (-1.0, 2), (np.nan, 1), (np.inf, 1), (0.01, 0)):
        assert lib.arm_init(ctypes.byref(state), ctypes.byref(Param(h, 1e9))) == status

    def step(q, rd=(1.0, 0.5, 0.0), x=None):
        given = In((number * 3)(*q), (number * 3)(*rd))
        if x is not None:
            state.x = (number * 3)(*x)
        before = bytes(state), bytes(out)
        status = lib.arm_step(
            ctypes.byref(state), ctypes.byref(given), ctypes.byref(out)
        )
        assert (status == 0) or (bytes(state), bytes(out)) == before
        return status

    assert step((0.1, 0.2, 0.3)) == 0
    assert step((0.1, np.nan, 0.3)) == 1
    assert step((0.1, 0.2, 0.3), rd=(np.inf, 0, 0)) == 1
    assert step((0.1, 0.2, 20.0)) == 3  # so far outside that (10) is empty
    assert step((0.1, 0.2, 0.3), x=(np.nan, 0, 0)) == 4
    largest = float(np.finfo(np.float32 if real == "float" else float).max)
    assert step((0.1, 0.2, 0.3), x=(largest,) * 3) == 4
    assert step((0.1, 0.2, 0.3), rd=(largest,) * 3) == 5


@pytest.mark.parametrize(("real", "step_size"), [("double", None), ("float", 0.002)])
def test_its_own_test_passes(networks, cc, tmp_path, real, step_size):
    package = generate(networks["rows"], real=real, steps=2, step_size=step_size)
    folder = package.write(tmp_path)
    done = run(host_test(cc, folder))
    assert done.returncode == 0
    assert done.stdout.startswith("PASS: 24 cases, 0 wrong, 0 self-test")


def test_its_own_test_can_fail(networks, cc, tmp_path):
    """One constant of the kernel changed a little: the vectors see it."""
    folder = generate(networks["box"], real="double").write(tmp_path)
    place = folder / "src/arm.c"
    text = place.read_text()
    head, kernel = text.split(" advance(", 1)
    assert "* 0.8" in kernel or "0.8 *" in kernel
    place.write_text(head + " advance(" + kernel.replace("0.8", "0.80000001", 1))
    done = run(host_test(cc, folder))
    assert done.returncode == 1
    assert done.stdout.startswith("FAIL")


def test_two_packages_live_in_one_image(networks, cc, tmp_path):
    folders = {
        prefix: generate(networks[name], prefix=prefix, real=real).write(tmp_path)
        for prefix, name, real in (
            ("left", "box", "float"),
            ("right", "rows", "double"),
        )
    }
    main = tmp_path / "main.c"
    main.write_text(
        '#include "left.h"\n#include "right.h"\n#include <string.h>\n'
        "int main(void)\n{\n"
        "    left_param_t a = {0.01F, 1.0F};\n    right_param_t b = {0.01, 1.0};\n"
        "    left_state_t s;\n    right_state_t r;\n"
        "    const int ok = (left_init(&s, &a) == LEFT_OK)\n"
        "        && (right_init(&r, &b) == RIGHT_OK);\n"
        "    const int same = strcmp(left_model_hash(), right_model_hash()) == 0;\n"
        "    return (ok && !same) ? 0 : 1;\n}\n"
    )
    sources = [main, *(folder / f"src/{p}.c" for p, folder in folders.items())]
    includes = [folder / "include" for folder in folders.values()]
    program = cc(sources, "both", includes=includes)
    assert run(program).returncode == 0


@pytest.mark.skipif(shutil.which("nm") is None, reason="needs nm")
def test_only_the_prefixed_functions_are_visible(networks, cc, tmp_path):
    folder = generate(networks["rows"]).write(tmp_path)
    program = cc([folder / "src/arm.c"], "arm.o", "-c", includes=[folder / "include"])
    listed = subprocess.run(["nm", program], capture_output=True, text=True, check=True)
    rows = [line.split() for line in listed.stdout.splitlines()]
    defined = {row[-1] for row in rows if row[-2] in "TDBCRV"}
    functions = ("init", "step", "monitor", "model_hash")
    assert defined == {f"arm_{name}" for name in functions}
    assert not {row[-1] for row in rows if row[-2] in "dDbBC"}  # no variables
    assert {row[-1] for row in rows if row[-2] == "U"} <= {"memset", "memcpy", "sqrtf"}


@pytest.mark.skipif(shutil.which("g++") is None, reason="needs g++")
def test_the_header_is_cpp_too(networks, tmp_path):
    folder = generate(networks["box"]).write(tmp_path)
    probe = tmp_path / "probe.cpp"
    probe.write_text(
        '#include "arm.h"\nint main() { arm_state_t s; return arm_init(&s, 0); }\n'
    )
    call = ["g++", "-std=c++17", "-Wall", "-Wextra", "-Werror", "-fsyntax-only"]
    done = run(*call, f"-I{folder / 'include'}", str(probe))
    assert done.returncode == 0, done.stderr


def test_a_network_without_parameters_or_formulation(cc, tmp_path):
    x = Symbol.scalar("tick", "1", "ends the comment */ int evil; /* and \n a line")
    dynamics = NeuralDynamics("decay", x, (), -x.sx, 2 * x.sx, x.sx)
    folder = generate(dynamics, prefix="d", real="double", steps=3).write(tmp_path)
    assert run(host_test(cc, folder)).returncode == 0
    assert "int evil; / *" in (folder / "include/d.h").read_text()
