import ctypes
import importlib.util
import subprocess
from pathlib import Path

import pytest

import rrnn_opt as rr
from rrnn_opt.emit import find_compiler

LANGUAGE = ["-std=c99", "-O2", "-ffp-contract=off", "-Werror"]
WARNINGS = ["all", "extra", "pedantic", "conversion", "shadow", "double-promotion"]
WARNINGS += ["float-conversion", "missing-prototypes"]


@pytest.fixture(scope="session")
def networks():
    kin = rr.Kinematics(rr.Robot.builtin("planar3"))
    rule = rr.networks.PrimalDual(epsilon=0.05)
    return {
        "box": rule(rr.formulations.position_feedback(kin, epsilon=0.05)),
        "rows": rule(rr.formulations.minimum_velocity(kin)),
    }


@pytest.fixture
def cc(tmp_path):
    """Compile sources with every warning an error."""
    command = find_compiler().command

    def compile_(sources, out, *flags, includes=()):
        places = [f"-I{folder}" for folder in includes]
        warn = [f"-W{name}" for name in WARNINGS]
        call = [
            *command,
            *LANGUAGE,
            *warn,
            *flags,
            *places,
            *map(str, sources),
            "-lm",
            "-o",
        ]
        call.append(str(tmp_path / out))
        done = subprocess.run(call, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        assert done.stderr == ""
        return Path(tmp_path / out)

    return compile_


@pytest.fixture
def library(cc):
    """Where a package's shared object is."""

    def build(folder, *flags):
        sources = sorted((folder / "src").glob("*.c"))
        call = ["-shared", "-fPIC", *flags]
        name = f"{folder.name}.so"
        return cc(sources, name, *call, includes=[folder / "include"])

    return build


@pytest.fixture
def shared(library):
    """A package as a loaded shared object."""
    return lambda folder, *flags: ctypes.CDLL(str(library(folder, *flags)))


@pytest.fixture
def controller(library):
    """A package's own Python module, over its C compiled here."""

    def build(package, folder, *flags, **settings):
        written = package.write(folder)
        place = library(written, *flags)
        name = package.prefix
        spec = importlib.util.spec_from_file_location(
            f"{name}_wrapper", written / "python" / f"{name}.py"
        )
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module, module.Controller(place, **settings)

    return build
