"""What MANIFEST.json says of a package."""

from __future__ import annotations

import json
from dataclasses import asdict
from importlib import metadata
from typing import Any

from rrnn_opt.dynamics import DiscreteDynamics
from rrnn_opt.embedding.kernel import Field, Kernel
from rrnn_opt.embedding.options import Options
from rrnn_opt.embedding.step_claim import SafeStep
from rrnn_opt.networks import Network
from rrnn_opt.robot import Robot

_COSTS = ("flash_bytes", "ram_bytes", "stack_bytes", "instructions")
_UNMEASURED = (
    "not measured; `rrnn generate --target cortex-m4f` does, where the Debian packages"
    " gcc-arm-none-eabi, libnewlib-arm-none-eabi and qemu-system-arm are installed"
)


def facts(
    core: Kernel,
    options: Options,
    network: Network | None,
    longest: float | None,
) -> dict[str, Any]:
    """Everything but the list of files; no dates and no machine names.

    Args:
        core: the functions.
        options: what was asked for.
        network: the rule that made the dynamics, if it is known.
        longest: Euler step, s, up to which a bound is known; None without.
    """
    form = core.dynamics.formulation
    chosen = asdict(options)
    prefix = chosen.pop("prefix")
    return {
        "prefix": prefix,
        "model_hash": core.tape.fingerprint,
        "network": core.dynamics.name,
        "rule": None
        if network is None
        else {"name": type(network).__name__, **asdict(network)},  # type: ignore[call-overload]
        "discretisation": _discretisation(core, options, longest),
        "formulation": None
        if form is None
        else {
            "name": form.name,
            "fingerprint": form.fingerprint,
            "citation": form.citation,
        },
        "options": chosen,
        "operations_per_step": core.tape.n_values,
        "footprint": dict.fromkeys(_COSTS) | {"reason": _UNMEASURED},
        "state": _row(core.state),
        "inputs": [_row(field) for field in core.inputs],
        "output": _row(core.output),
        "versions": {name: metadata.version(name) for name in ("rrnn_opt", "casadi")},
    }


def robot_facts(robot: Robot | None) -> dict[str, Any] | None:
    """Whose joints the arguments speak of, in which order, and of which frame.

    Args:
        robot: the arm, if it is known.
    """
    if robot is None:
        return None
    joints = list(robot.joint_names)
    return {"name": robot.name, "joints": joints, "frame": robot.tip}


def _discretisation(
    core: Kernel, options: Options, longest: float | None
) -> dict[str, Any]:
    if isinstance(core.dynamics, DiscreteDynamics):
        return {"method": "map", "steps": options.steps}
    return {
        "method": "explicit Euler",
        "steps": options.steps,
        "step_size_s": options.step_size,
        "longest_step_s": longest,
    }


def _row(field: Field) -> dict[str, Any]:
    return {
        "name": field.name,
        "shape": list(field.shape),
        "unit": field.unit,
        "meaning": field.meaning,
    }


def claim_files(safe: SafeStep | None) -> tuple[list[dict[str, Any]], dict[str, str]]:
    """What is proved of exactly this network and step: manifest rows, certificates.

    Args:
        safe: the claim behind the longest step; None without one.
    """
    if safe is None:
        return [], {}
    proof = safe.proof()
    verdict = proof.settle()
    path = f"claims/{proof.claim.id}.json"
    row = {
        "id": proof.claim.id,
        "statement": proof.claim.statement,
        "source": proof.claim.source,
        "dynamics": proof.claim.order,
        "jacobian": proof.claim.jacobian,
        "verdict": verdict.status,
        "trust": verdict.trust,
        "assumptions": list(verdict.assumptions),
        "certificate": None if verdict.certificate is None else path,
    }
    if verdict.certificate is None:
        return [row], {}
    return [row], {path: json.dumps(verdict.certificate, sort_keys=True) + "\n"}
