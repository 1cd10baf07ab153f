from ctypes import c_double

import pytest

from rrnn_opt.emit import build, find_compiler, load
from rrnn_opt.emit.host import compile_text
from rrnn_opt.errors import CompilerError

EXPORT = '__attribute__((visibility("default"))) '


def test_refused_text_names_the_first_error(cold_cache):
    with pytest.raises(CompilerError, match="nonsense") as caught:
        build("int f(void) { return nonsense; }", name="bad")
    assert caught.value.command is not None
    assert "nonsense" in caught.value.output
    assert list(cold_cache.glob("*.so")) == []


def test_a_hanging_compiler_is_stopped(tmp_path, monkeypatch):
    tool = tmp_path / "cc"
    tool.write_text('#!/bin/sh\n[ "$1" = --version ] && exit 0\nsleep 60\n')
    tool.chmod(0o755)
    monkeypatch.setenv("CC", str(tool))
    found = find_compiler()
    with pytest.raises(CompilerError, match=r"did not end within 0\.2 s"):
        compile_text("int x;", found.flags, found, timeout=0.2)


def test_a_function_called_step_or_exp_stays_our_own():
    source = (
        "double exp(double);\n"
        f"{EXPORT}double step(double);\n"
        f"{EXPORT}double step(double x) {{ return x + 1.0; }}\n"
        f"{EXPORT}double twice(double x) {{ return step(step(x)); }}\n"
    )
    first = load(build(source, name="one"))
    second = load(build(source.replace("1.0", "10.0"), name="two"))
    for library, wanted in ((first, 2.0), (second, 20.0)):
        function = library.twice
        function.argtypes, function.restype = [c_double], c_double
        assert function(0.0) == wanted


def test_an_unresolved_name_fails_when_loading():
    body = "int f(void) { return nowhere_defined(); }"
    source = f"int nowhere_defined(void);\n{EXPORT}{body}"
    with pytest.raises(CompilerError, match="nowhere_defined"):
        load(build(source, name="loose"))


def test_contraction_is_off():
    body = "double a, double b, double c) { return a * b + c; }"
    function = load(build(f"{EXPORT}double fma_like({body}", name="contract")).fma_like
    function.argtypes, function.restype = [c_double] * 3, c_double
    a = 1.0 + 2.0**-30
    assert function(a, a, -(a * a)) == 0.0


def test_the_name_of_the_file_is_readable(cold_cache):
    built = build("int x;", name="a b/c")
    assert built.path.name.startswith("a_b_c-")
    assert built.seconds > 0
    assert built.compiler == find_compiler().version
