"""cppcheck's MISRA findings are those that the package itself lists."""

import re
import shutil
import subprocess

import pytest

import rrnn_opt as rr
from rrnn_opt.embedding import generate

FOUND = re.compile(r"^(\S+?):\d+:.*\[misra-c2012-([\d.]+)\]$", re.M)
ROW = re.compile(r"^\| ([\d.]+) \| ([^|]+) \|", re.M)


@pytest.mark.slow
def test_the_findings_are_the_listed_ones(tmp_path):
    if shutil.which("cppcheck") is None:
        pytest.skip("needs apt install cppcheck")
    kin = rr.Kinematics(rr.Robot.builtin("planar3"))
    law = rr.networks.LviPdnn(whiten=True)(rr.formulations.minimum_velocity(kin))
    package = generate(law, prefix="arm")
    folder = package.write(tmp_path)
    sources = sorted(str(p.relative_to(folder)) for p in folder.glob("src/*.c"))
    command = ["cppcheck", "--addon=misra", "--std=c99", "--quiet"]
    done = subprocess.run(
        [*command, "-Iinclude", "-Isrc", *sources],
        cwd=folder,
        capture_output=True,
        text=True,
        check=True,
        timeout=300.0,
    )
    found = {(rule, place) for place, rule in FOUND.findall(done.stderr)}
    listed = {
        (rule, place.strip())
        for rule, places in ROW.findall(package.files["MISRA.md"])
        for place in places.split(",")
    }
    assert found == listed
