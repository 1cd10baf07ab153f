"""A million random control steps of generated controllers, their monitor on.

    python -m benchmarks.control_steps [--steps N] [--seed S] [--out FILE]

Every case is a scheme, a network, a robot and a type of numbers; its package is
compiled beside ``control_steps.c``.  Of 96 requests 64 walk slowly (a network can
follow), 16 jump, 16 hold anything: NaN, infinities, denormals, random bytes, angles
beyond all limits.  An output must be finite; where the status is OK and the verdict
does not say that the residual is large, or says that the exact solver answered, it
must lie within the limits of the request, which are emitted apart and in double.
A refused request must leave state and output as they were.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np

import rrnn_opt as rr
from rrnn_opt import formulations, networks
from rrnn_opt.dynamics import Dynamics
from rrnn_opt.embedding import generate
from rrnn_opt.emit import find_compiler
from rrnn_opt.emit.program import program_source
from rrnn_opt.report import write_text
from rrnn_opt.study.environment import commit
from rrnn_opt.symbolic import Tape
from rrnn_opt.validation.ending import ended

HARNESS = Path(__file__).with_name("control_steps.c")
PAGE = Path(__file__).parents[1] / "docs" / "results" / "control_steps.md"
STEPS = 1_200_000
SCHEMES = (
    "minimum_velocity",
    "closed_loop",
    "joint_limit_avoidance",
    "minimum_acceleration",
    "repetitive_motion",
    "position_feedback",
    "manipulability",
    "clearance_rows",
)
NETWORKS = (
    "PrimalDual",
    "LviPdnn",
    "DualNetwork",
    "Hildreth",
    "SimplifiedLviPdnn",
    "Lvi94",
    "E47",
)
ROBOTS = ("pa10", "panda", "raven2")
STATUS = ("ok", "not finite", "bad step", "empty limits", "diverged", "out of range")
STATUS += ("step too long", "bad tolerance", "infeasible", "no answer")


@dataclass(frozen=True)
class Case:
    """One controller; ``network`` is built with its defaults."""

    robot: str
    scheme: str
    network: str
    real: str
    fallback: bool

    def __str__(self) -> str:
        solver = "with" if self.fallback else "without"
        return f"{self.scheme}, {self.network}, {self.robot}, {self.real}, {solver}"


def cases() -> list[Case]:
    """Every scheme on every robot; networks, types and fallback take turns."""
    pairs = [(robot, scheme) for robot in ROBOTS for scheme in SCHEMES]
    return [
        Case(
            robot,
            scheme,
            NETWORKS[k % len(NETWORKS)],
            ("float", "double")[(k + k // 2) % 2],
            k % 3 != 2,
        )
        for k, (robot, scheme) in enumerate(pairs)
    ]


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


def report(found: dict[Case, dict[str, Any]], command: str) -> str:
    """The table that is kept."""
    total = sum(sum(row["status"]) for row in found.values())
    broken = sum(row["broken"] for row in found.values())
    head = (
        "# Random control steps, monitor on",
        "",
        f"Made by `{command}` on {time.strftime('%Y-%m-%d', time.gmtime())}, commit"
        f" {commit() or 'unknown'}, {find_compiler().version}.",
        "",
        *_words(),
        "",
        f"**{total} steps, {broken} broken promises.**",
        "",
    )
    top = ("controller (exact solver behind it)", "steps", "ok", "exact solver")
    top += ("flagged", "refused, with the reason", "beyond limits: promised / flagged")
    lines = [top, ("---",) + ("---:",) * 4 + ("---", "---:")]
    lines += [_line(case, row) for case, row in found.items()]
    table = ["| " + " | ".join(line) + " |" for line in lines]
    return "\n".join([*head, *table]) + "\n"


def _words() -> tuple[str, ...]:
    return (
        "Of 96 requests 64 walk slowly, 16 jump, 16 hold anything: NaN, infinities,",
        "denormals, random bytes, angles beyond all limits.  *Refused* steps leave",
        "state and output untouched.  *Flagged*: the status is OK and the verdict says",
        "that the KKT residual is above the tolerance, so that the network has not",
        "settled; such an output is finite, but may lie beyond the limits.  All other",
        "outputs are *promised*: settled to the tolerance (0.01), or the exact",
        "solver's.  The last column is the largest distance beyond the limits (rad/s,",
        "or rad/s2), rounding set aside.",
    )


def _line(case: Case, row: dict[str, Any]) -> tuple[str, ...]:
    refused = (f"{n} {s}" for n, s in zip(row["status"][1:], STATUS[1:], strict=True))
    return (
        str(case),
        str(sum(row["status"])),
        str(row["status"][0]),
        str(row["fell_back"]),
        str(row["flagged"]),
        ", ".join(text for text in refused if not text.startswith("0 ")),
        f"{row['worst_promised']:.2g} / {row['worst_flagged']:.2g}",
    )


def main(argv: Sequence[str] | None = None) -> int:
    """Drive all cases; 1 when a promise was broken."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=STEPS)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--out", type=Path, default=PAGE)
    args = parser.parse_args(argv)
    each = -(-args.steps // len(cases()))
    found = {}
    for case in cases():
        found[case] = run(case, each, args.seed)
        print(f"{case}: {found[case]}", flush=True)
    command = f"python -m benchmarks.control_steps --steps {args.steps}"
    write_text(args.out, report(found, f"{command} --seed {args.seed}"))
    return 1 if any(row["broken"] for row in found.values()) else 0


if __name__ == "__main__":
    sys.exit(ended(main))
