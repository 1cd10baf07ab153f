"""rrnn_opt: one symbolic law in; a proof, a solver, a plan and a controller out.

The nouns and verbs of the package; everything is imported when first used,
so that ``import rrnn_opt`` costs nothing.
"""

from __future__ import annotations

import importlib
from typing import Any

_HOME = {
    # nouns
    "Robot": "rrnn_opt.robot",
    "Kinematics": "rrnn_opt.robot",
    "Symbol": "rrnn_opt.symbolic",
    "Formulation": "rrnn_opt.formulation",
    "NeuralDynamics": "rrnn_opt.dynamics",
    "DiscreteDynamics": "rrnn_opt.dynamics",
    "Euler": "rrnn_opt.dynamics",
    "LyapunovFunction": "rrnn_opt.lyapunov",
    "Claim": "rrnn_opt.claim",
    "Relation": "rrnn_opt.claim",
    "Hypothesis": "rrnn_opt.claim",
    "Range": "rrnn_opt.claim",
    "Scene": "rrnn_opt.scene",
    "Problem": "rrnn_opt.planning",
    "Task": "rrnn_opt.simulation",
    # verbs
    "plan": "rrnn_opt.planning",
    "plan_many": "rrnn_opt.planning",
    "retime": "rrnn_opt.motion",
    "settle": "rrnn_opt.solving",
    "compare": "rrnn_opt.solving",
    "simulate": "rrnn_opt.simulation",
    "certify": "rrnn_opt.verification",
    "certify_region": "rrnn_opt.verification",
    "Region": "rrnn_opt.verification",
    "generate": "rrnn_opt.embedding",
}
_ROOMS = (
    "formulations",
    "networks",
    "emit",
    "scene",
    "robot",
    "symbolic",
    "check",
    "solving",
    "simulation",
    "verification",
    "study",
    "validation",
)
__all__ = list(_HOME) + list(_ROOMS)


def __getattr__(name: str) -> Any:
    if name == "__version__":
        from importlib import metadata  # costs as much as all the rest

        return metadata.version("rrnn_opt")
    if name in _HOME:
        return getattr(importlib.import_module(_HOME[name]), name)
    if name in _ROOMS:
        return importlib.import_module(f"rrnn_opt.{name}")
    raise AttributeError(f"module 'rrnn_opt' has no attribute '{name}'")


def __dir__() -> list[str]:
    return sorted(__all__)
