"""The FMU is one to a public checker, and computes what the package computes."""

from __future__ import annotations

import platform
import shutil

import numpy as np
import pytest

from rrnn_opt.embedding import generate

GIVEN = {"q": [0.3, 0.4, 0.5], "rd": [1.2, 0.9, 0.0]}
SHARED = ("-shared", "-fPIC")


@pytest.fixture(params=["double", "float"])
def package(networks, request):
    return generate(
        networks["box"],
        real=request.param,
        step_size=0.002,
        layout=("arduino", "fmu"),
    )


def fmu_of(folder, cc):
    """The folder with its library for this machine, as an FMU beside it."""
    library = cc(sorted((folder / "sources").glob("*.c")), "arm_fmu.so", *SHARED)
    place = folder / "binaries" / f"{platform.machine()}-linux" / "arm.so"
    place.parent.mkdir(parents=True)
    shutil.copy(library, place)
    archive = shutil.make_archive(str(folder.parent / "arm"), "zip", folder)
    return shutil.move(archive, folder.parent / "arm.fmu")


def test_the_fmu_holds_and_agrees(package, cc, controller, tmp_path):
    fmpy = pytest.importorskip("fmpy", reason="needs fmpy (PyPI)")
    from fmpy.fmi3 import FMU3Slave
    from fmpy.validation import validate_fmu

    folder = package.write(tmp_path) / "fmu"
    archive = str(fmu_of(folder, cc))
    assert validate_fmu(archive) == []
    description = fmpy.read_model_description(archive)
    slave = FMU3Slave(
        guid=description.guid,
        unzipDirectory=str(folder),
        modelIdentifier="arm",
        instanceName="one",
    )
    references = {v.name: v.valueReference for v in description.modelVariables}
    single = package.manifest["options"]["real"] == "float"
    kind = "Float32" if single else "Float64"
    slave.instantiate()
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    _, arm = controller(package, tmp_path / "again")
    for k in range(5):
        for name, values in GIVEN.items():
            getattr(slave, f"set{kind}")([references[name]], values)
        slave.doStep(k * 1e-3, 1e-3)
        got = getattr(slave, f"get{kind}")([references["output"]], 3)
        np.testing.assert_array_equal(list(got), arm.step(**GIVEN))
        assert list(slave.getUInt32([references["out.status"]])) == [0]
    slave.terminate()
    slave.freeInstance()


def test_the_arduino_library_is_flat_and_whole(package, cc, tmp_path):
    library = package.write(tmp_path) / "arduino" / "arm"
    properties = (library / "library.properties").read_text()
    for key in ("name=arm", "version=", "architectures=*", "includes=arm.h"):
        assert key in properties
    for source in sorted((library / "src").glob("*.c")):
        cc([source], f"{source.stem}.o", "-c")
    sketch = (library / "examples" / "arm_loop" / "arm_loop.ino").read_text()
    assert "arm_step(&state, &in, &out)" in sketch
