"""One generated controller, compiled beside ``harness.c`` and driven."""

from __future__ import annotations

import json
import subprocess
import tempfile
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np

import rrnn_opt as rr
from benchmarks.control_steps.cases import Case
from rrnn_opt import formulations, networks
from rrnn_opt.dynamics import Dynamics
from rrnn_opt.embedding import generate
from rrnn_opt.emit import find_compiler
from rrnn_opt.emit.program import program_source
from rrnn_opt.symbolic import Tape

HARNESS = Path(__file__).with_name("harness.c")


def law(case: Case, kin: rr.Kinematics) -> tuple[Dynamics, dict[str, Any]]:
    """The network's dynamics and what the package is told besides."""
    rule = getattr(networks, case.network)()
    dynamics = rule(getattr(formulations, case.scheme)(kin))
    return dynamics, {"network": rule, "kinematics": kin}


def centre(dynamics: Dynamics, kin: rr.Kinematics) -> str:
    """Inputs at rest in the middle of the joints' ranges, as C literals."""
    bounds = kin.robot.limits
    span = np.clip([bounds.lower, bounds.upper], -1.0, 4.0)
    middle = np.mean(span, axis=0)
    tip = np.asarray(kin.functions()["position"](middle)).ravel()
    rest = {"q": middle, "q_start": middle, "rd": tip}
    values = [rest.get(p.name, np.zeros(p.size)) for p in dynamics.parameters]
    return ", ".join(repr(float(x)) for x in np.concatenate(values))


def limits(dynamics: Dynamics) -> str:
    """C of the limits as a function of all inputs, in double: an own translation."""
    form = dynamics.formulation
    columns = [ca.vec(p.sx) for p in dynamics.parameters]
    values = [ca.densify(form.lower), ca.densify(form.upper)]
    names = ["lower", "upper"]
    function = ca.Function("bounds", [ca.vertcat(*columns)], values, ["given"], names)
    return program_source({"bounds": Tape.of(function)}, "limits", real="double")


def run(case: Case, steps: int, seed: int) -> dict[str, Any]:
    """Compile one controller, drive it, and say what was seen."""
    kin = rr.Kinematics(rr.Robot.builtin(case.robot))
    dynamics, given = law(case, kin)
    package = generate(
        dynamics, prefix="arm", real=case.real, fallback=case.fallback, **given
    )
    with tempfile.TemporaryDirectory() as name:
        folder = package.write(name)
        (folder / "limits.c").write_text(limits(dynamics))
        sources = [HARNESS, folder / "limits.c", *sorted(folder.glob("src/*.c"))]
        words = [*find_compiler().command, "-std=c99", "-O2", "-ffp-contract=off"]
        words += [f"-DCENTRE={centre(dynamics, kin)}", f"-I{folder / 'include'}"]
        words += [*map(str, sources), "-lm"]
        program = folder / "drive"
        subprocess.run([*words, "-o", str(program)], check=True)
        call = [str(program), str(steps), str(seed)]
        done = subprocess.run(call, capture_output=True, text=True, check=True)
    return json.loads(done.stdout)
