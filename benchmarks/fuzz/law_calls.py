"""What schemes, solvers, studies and proofs are made by, with right arguments."""

from __future__ import annotations

import functools
from typing import Any

import numpy as np

from benchmarks.fuzz.motion_calls import Call, fields_of


@functools.cache
def symbolic_calls() -> dict[str, Call]:
    """Symbols, sets, schemes, networks, solving, claims."""
    return _laws() | _sets() | _solvers() | _judges() | _claims()


def _laws() -> dict[str, Call]:
    import rrnn_opt as rr
    from rrnn_opt import formulations, networks

    kin = rr.Kinematics(rr.Robot.builtin("planar3"))
    rules = (networks.E47, networks.DualNetwork, networks.FiniteTimeZnn)
    rules += (networks.Hildreth, networks.Lvi94, networks.LviPdnn, networks.PrimalDual)
    rules += (networks.NoiseTolerantZnn, networks.SimplifiedLviPdnn, networks.Znn)
    rules += (networks.VaryingGainZnn, networks.MemoryCell)
    schemes = {
        name: (getattr(formulations, name), {"kin": kin, **_scheme(name)})
        for name in formulations.__all__
        if name != "slide"
    }
    return {
        **{rule.__name__: (rule, fields_of(rule())) for rule in rules},
        **schemes,
        "kin.position": (kin.position, {"frame": "tip"}),
        "kin.jacobian": (kin.jacobian, {"frame": "tip"}),
    }


def _sets() -> dict[str, Call]:
    import casadi as ca

    from rrnn_opt import symbolic

    x = ca.SX.sym("x", 3)
    return {
        "Symbol": (symbolic.Symbol, {"name": "x", "sx": x, "unit": "m"}),
        "sets.Box": (symbolic.Box, {"lower": np.zeros(3), "upper": np.ones(3)}),
        "sets.Ball": (symbolic.Ball, {"center": np.zeros(3), "radius": 1.0}),
        "sets.Orthant": (symbolic.Orthant, {"dimension": 3}),
        "sets.Product": (symbolic.Product, {"factors": (symbolic.Orthant(2),)}),
        "Box.project": (
            symbolic.Box(np.zeros(3), np.ones(3)).project,
            {"x": [1, 2, 3]},
        ),
    }


def _solvers() -> dict[str, Call]:
    import rrnn_opt as rr
    from rrnn_opt import networks, solving

    kin = rr.Kinematics(rr.Robot.builtin("planar3"))
    form = rr.formulations.minimum_velocity(kin)
    point = {"q": [0.3, 0.5, 0.7], "rd_dot": [0.01, 0.0, 0.0]}
    return {
        "Euler": (rr.Euler, {"h": 0.01}),
        "qp.at": (form.qp.at, point),
        "settle": (
            rr.settle,
            {"dyn": networks.PrimalDual()(form), "tolerance": 1e-6, "max_steps": 100}
            | {"step": None, "start": None, "newton": True, **point},
        ),
        "Qpsolvers": (solving.Qpsolvers, {"name": "daqp", "tolerance": 1e-6}),
        "OsqpSession": (solving.OsqpSession, {"mode": "warm", "tolerance": 1e-6}),
        "DaqpSession": (solving.DaqpSession, {"mode": "warm", "tolerance": 1e-6}),
        "ActiveSet": (solving.ActiveSet, {"mode": "cold", "tolerance": 1e-6}),
        "compile": (rr.emit.compile, {"functions": [], "name": "f", "real": "double"}),
    }


def _judges() -> dict[str, Call]:
    import qpsolvers

    from rrnn_opt import solving

    qp = qpsolvers.Problem(np.eye(2), np.ones(2), lb=-np.ones(2), ub=np.ones(2))
    return {
        "Tolerances": (solving.Tolerances, fields_of(solving.Tolerances())),
        "kkt_residual": (
            solving.kkt_residual,
            {"problem": qp, "x": np.zeros(2), "duals": None},
        ),
        "judge": (
            solving.judge,
            {"problem": qp, "x": np.zeros(2), "duals": None, "tolerance": 1e-6},
        ),
    }


def _claims() -> dict[str, Call]:
    import casadi as ca

    from rrnn_opt import symbolic
    from rrnn_opt.claim import Claim, Range, Relation

    x = ca.SX.sym("x", 3)
    return {
        "Relation": (Relation, {"expression": x, "sense": ">=0"}),
        "Range": (Range, {"variable": "x", "lower": (None,), "upper": (None,)}),
        "Claim": (
            Claim,
            {
                "id": "C",
                "source": "s",
                "statement": "t",
                "variables": (symbolic.Symbol("x", x),),
                "goal": Relation(x, ">=0"),
                "order": None,
                "jacobian": None,
            },
        ),
    }


def _scheme(name: str) -> dict[str, Any]:
    import inspect

    from rrnn_opt import formulations

    wanted = inspect.signature(getattr(formulations, name)).parameters
    return {k: p.default for k, p in wanted.items() if k != "kin"}


@functools.cache
def other_calls() -> dict[str, Call]:
    """Studies, verification, packages, checks."""
    return _studies() | _regions() | _packages()


def _studies() -> dict[str, Call]:
    from rrnn_opt import study

    return {
        "wilson": (study.wilson, {"successes": 3, "n": 10, "confidence": 0.95}),
        "Processes": (study.Processes, {"jobs": 1, "attempts": 2, "patience_s": 1.0}),
        "Cluster": (study.Cluster, {"address": "tcp://127.0.0.1:1", "ahead": 3}),
        "local": (study.local, {"jobs": 1}),
        "generator": (study.generator, {"case": study.Case("k"), "seed": 0}),
    }


def _regions() -> dict[str, Call]:
    from rrnn_opt import verification
    from rrnn_opt.robot import Robot

    region = {"centre": (0.0, 0.5, 1.0), "half_widths": (0.1, 0.1, 0.1)}
    return {
        "Region": (verification.Region, region),
        "certify_region": (
            verification.certify_region,
            {
                "arm": Robot.builtin("planar3"),
                "region": verification.Region(**region),
                "epsilon": 0.05,
                "error": 0.1,
                "gain": 0.5,
                "floor": 0.02,
                "joints": (1, 2),
                "grid": (1, 1),
                "budget_s": 0.2,
                "jobs": 1,
            },
        ),
    }


def _packages() -> dict[str, Call]:
    import rrnn_opt as rr
    from rrnn_opt import check
    from rrnn_opt.embedding.options import Options

    arm = rr.Robot.builtin("planar3")
    form = rr.formulations.minimum_velocity(rr.Kinematics(arm))
    dynamics = rr.networks.PrimalDual()(form)
    return {
        "Options": (Options, fields_of(Options())),
        "generate": (
            rr.generate,
            {"dynamics": dynamics, "prefix": "arm", "real": "float", "steps": 1}
            | {"step_size": 0.001, "tolerance": 0.01, "target": "host", "layout": ()},
        ),
        "check_plan": (check.check_plan, {"document": {}}),
        "certify_trajectory": (
            check.certify_trajectory,
            {"robot": arm.to_dict(), "problem": {}, "trajectory": {}},
        ),
    }
