"""Determinism, the manifest, and options that cannot be used."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import casadi as ca
import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.embedding import generate
from rrnn_opt.errors import RrnnError
from rrnn_opt.symbolic import Symbol

SCRIPT = """
import hashlib, rrnn_opt as rr
kin = rr.Kinematics(rr.Robot.builtin("planar3"))
form = rr.formulations.minimum_velocity(kin)
package = rr.generate(rr.networks.PrimalDual()(form), steps=2, step_size=1e-3)
print(hashlib.sha256(repr(sorted(package.files.items())).encode()).hexdigest())
"""


def test_the_same_model_gives_the_same_bytes(capfd):
    """Here, and in a process whose sets and dictionaries are in another order."""
    exec(SCRIPT, {})
    here = capfd.readouterr().out
    env = os.environ | {"PYTHONHASHSEED": "1"}
    call = [sys.executable, "-c", SCRIPT]
    done = subprocess.run(call, capture_output=True, text=True, env=env, check=True)
    assert done.stdout == here


def test_the_manifest_tells_what_it_is_made_of(networks):
    package = rr.generate(networks["rows"], prefix="Arm_7", steps=4, step_size=0.001)
    manifest = json.loads(package.files["MANIFEST.json"])
    assert manifest["formulation"]["name"] == "minimum_velocity"
    assert manifest["options"]["real"] == "float"
    assert manifest["options"]["steps"] == 4
    assert manifest["options"]["step_size"] == 0.001
    assert [row["name"] for row in manifest["inputs"]] == ["q", "rd_dot"]
    assert set(manifest["files"]) | {"MANIFEST.json"} == set(package.files)
    other = rr.generate(networks["box"])
    assert other.manifest["model_hash"] != manifest["model_hash"]


@pytest.mark.parametrize(
    "options",
    [
        {"prefix": prefix}
        for prefix in (
            "",
            "int",
            "1a",
            "a b",
            "a;b",
            "../up",
            "_x",
            "math",
            "Float",
            "é",
            "a" * 32,
        )
    ]
    + [
        {"prefix": "arm\n"},
        {"real": "half"},
        {"steps": 0},
        {"steps": 1.5},
        {"steps": True},
    ]
    + [{"step_size": h} for h in (0.0, -1.0, np.nan, np.inf, 1e-60)],
)
def test_options_that_make_no_sense_are_refused(networks, options):
    with pytest.raises(RrnnError):
        generate(networks["box"], **options)


def test_limits_that_are_always_empty_are_said():
    u = Symbol.vector("u", 1)
    form = rr.Formulation(
        "empty", u, (), ca.dot(u.sx, u.sx), lower=ca.SX(1), upper=ca.SX(-1)
    )
    with pytest.raises(RrnnError, match="limits"):
        generate(rr.networks.PrimalDual()(form))
