"""Every compiler is silent, few symbols are left to libraries, two live together."""

import shutil
import subprocess

import pytest

import rrnn_opt as rr
from rrnn_opt.embedding import generate
from rrnn_opt.embedding.target.board import BOARDS
from rrnn_opt.embedding.target.image import (
    compile_objects,
    link,
    run,
    undefined_symbols,
)
from tests.embedding.target.lab import WARNINGS
from tests.embedding.target.scenarios import arm, scheme

ALLOWED = {"memcpy", "memset"}
"""A compiler may call these two for struct assignments in every C program."""
SOFT = "__aeabi_"
"""Prefix of the compiler's own functions for doubles without hardware."""


@pytest.fixture(scope="module")
def packages(tmp_path_factory):
    """Folders: contact rows in float, equality rows alone in double."""
    folder = tmp_path_factory.mktemp("packages")
    rule = rr.networks.LviPdnn(whiten=True)
    made = (
        ("left", scheme(), "float"),
        ("right", rr.formulations.minimum_velocity(arm()), "double"),
    )
    return {
        prefix: generate(rule(form), prefix=prefix, real=real).write(folder)
        for prefix, form, real in made
    }


def sources(folder, *tests):
    return [*sorted(folder.glob("src/*.c")), *(folder / "test" / t for t in tests)]


def includes(folder):
    return [folder / "include", folder / "test", folder / "test" / "target"]


@pytest.mark.slow
@pytest.mark.parametrize("compiler", ["gcc", "clang"])
@pytest.mark.parametrize("prefix", ["left", "right"])
@pytest.mark.parametrize("level", ["-O0", "-O2"])
def test_host_compilers_have_nothing_to_say(packages, compiler, prefix, level):
    if shutil.which(compiler) is None:
        pytest.skip(f"needs apt install {compiler}")
    folder = packages[prefix]
    places = [f"-I{p}" for p in includes(folder)]
    for source in sources(folder, "test_host.c"):
        command = [compiler, "-std=c99", level, *WARNINGS, *places]
        command += ["-c", str(source), "-o", "/dev/null"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.slow
@pytest.mark.parametrize("prefix", ["left", "right"])
@pytest.mark.parametrize("name", BOARDS)
def test_the_cross_compiler_neither(packages, prefix, name, tmp_path):
    folder, board = packages[prefix], BOARDS[name]
    tests = [
        "target/test_target.c",
        "target/application.c",
        "target/board.c",
        "target/startup.c",
    ]
    chosen = sources(folder, *tests)
    compile_objects(board, chosen, tmp_path, includes=includes(folder), flags=WARNINGS)
    own = [tmp_path / f"{source.stem}.o" for source in sources(folder)]
    left = undefined_symbols(own)
    real = {"left": "float", "right": "double"}[prefix]
    if real in board.hardware:
        assert left <= ALLOWED
    else:
        assert {name for name in left if not name.startswith(SOFT)} <= ALLOWED | {
            "sqrt"
        }


@pytest.mark.slow
def test_the_header_is_cpp17(packages, tmp_path):
    if shutil.which("g++") is None:
        pytest.skip("needs apt install g++")
    probe = tmp_path / "probe.cpp"
    probe.write_text(
        '#include "left.h"\n#include "right.h"\n'
        "int main() { left_state_t s{}; right_out_t o{};"
        " return static_cast<int>(s.tick + o.verdict); }\n"
    )
    places = [f"-I{folder / 'include'}" for folder in packages.values()]
    strict = ["-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror"]
    command = ["g++", *strict, *places, "-fsyntax-only", str(probe)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")


TWO = """
#include "board.h"
#include "left.h"
#include "right.h"

int main(void)
{
    const left_param_t a = {0.004F, 0.05F};
    const right_param_t b = {0.004, 0.05};
    left_state_t s;
    right_state_t r;
    board_number((uint32_t)left_init(&s, &a) + (uint32_t)right_init(&r, &b));
    board_text(" ");
    board_number(left_selftest() + right_selftest());
    board_text((left_model_hash()[0] == '\\0') ? " no hash" : " two");
    return 0;
}
"""


@pytest.mark.slow
def test_two_controllers_in_one_image(packages, tmp_path):
    board, main = BOARDS["cortex-m7"], tmp_path / "main.c"
    main.write_text(TWO)
    both = [path for folder in packages.values() for path in sources(folder)]
    places = [place for folder in packages.values() for place in includes(folder)]
    objects = compile_objects(
        board, [main, *both], tmp_path, includes=places, flags=WARNINGS
    )
    image = link(board, objects, tmp_path / "two.elf")
    assert run(board, image, tmp_path) == "0 0 two"
