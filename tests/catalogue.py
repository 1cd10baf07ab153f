"""Every exported scheme and every exported network, found by asking the package."""

import inspect
from dataclasses import dataclass
from functools import cache

import numpy as np
import qpsolvers

import rrnn_opt as rr
from rrnn_opt import formulations, networks
from rrnn_opt.errors import RrnnError
from tests.formulations.points import parameters

ROBOTS = ("planar3", "pa10")


@dataclass(frozen=True)
class Scheme:
    """A formulation's function, as it comes or with an option that it offers."""

    name: str
    option: str = ""

    def __str__(self):
        return ":".join(filter(None, (self.name, self.option)))

    def build(self, robot):
        last = len(kinematics(robot).robot.spheres) - 1
        options = {"contacts": {"contacts": (last,)}, "task": {"task": "pose"}}
        make = getattr(formulations, self.name)
        return make(kinematics(robot), **options.get(self.option, {}))


@cache
def kinematics(robot):
    return rr.Kinematics(rr.Robot.builtin(robot))


@cache
def schemes():
    found = []
    for name in formulations.__all__:
        offered = inspect.signature(getattr(formulations, name)).parameters
        found.append(Scheme(name))
        found += [Scheme(name, o) for o in ("contacts", "task") if o in offered]
    return tuple(found)


@cache
def rules():
    """Every network with its defaults and, where it offers that, whitened."""
    found = []
    for name in networks.__all__:
        kind = getattr(networks, name)
        if not issubclass(kind, networks.Network) or inspect.isabstract(kind):
            continue
        found.append(kind())
        if "whiten" in inspect.signature(kind).parameters:
            found.append(kind(whiten=True))
    return tuple(found)


def label(rule):
    white = "-whitened" if getattr(rule, "whiten", False) else ""
    return type(rule).__name__ + white


@cache
def form(robot, scheme):
    return scheme.build(robot)


@cache
def dynamics(robot, scheme, rule):
    """The network of a scheme, or None where it is refused."""
    try:
        return rule(form(robot, scheme))
    except RrnnError:
        return None


def accepted(robot, rule, chosen):
    """Pairs (scheme, dynamics) that the rule does not refuse."""
    made = ((scheme, dynamics(robot, scheme, rule)) for scheme in chosen)
    return [(scheme, law) for scheme, law in made if law is not None]


@dataclass(frozen=True, eq=False)
class Point:
    """Parameter values and what DAQP makes of them, in our signs.

    ``unique``: the active rows fix their multipliers.  ``mild``: no singular value
    of the active rows over the free coordinates is small, none of P small or
    large, so that every network must get there.  ``active``: some bound or row is.
    """

    given: dict
    x: np.ndarray
    lam: np.ndarray
    mu: np.ndarray
    box: np.ndarray
    unique: bool
    mild: bool
    active: bool


@cache
def points(robot, scheme, count=20):
    """Feasible seeded points, with small, middling and large demands by turns."""
    declared, found, seed = form(robot, scheme), [], 0
    while len(found) < count:
        assert seed < 50 * count, f"{scheme}: too few feasible points"
        size = (0.05, 1.2, 2.0)[seed % 3]
        given = parameters(declared, kinematics(robot), seed, size=size)
        seed += 1
        solved = solve(declared, given)
        if solved is not None:
            found.append(solved)
    return found


def solve(declared, given):
    """One point, or None when there is no feasible one."""
    try:
        problem = declared.qp.at(**given)
    except RrnnError:
        return None
    best = qpsolvers.solve_problem(
        problem, solver="daqp", primal_tol=1e-10, dual_tol=1e-12
    )
    if not best.found:
        return None
    n = declared.decision.size
    lower, upper = (
        np.full(n, side) if value is None else value
        for side, value in ((-np.inf, problem.lb), (np.inf, problem.ub))
    )
    near = np.minimum(best.x - lower, upper - best.x) < 1e-7
    tight = np.zeros(0, dtype=bool)
    if problem.G is not None:
        tight = problem.h - problem.G @ best.x < 1e-7
    shaped = {s.name: np.reshape(given[s.name], s.shape) for s in declared.parameters}
    return Point(
        given=shaped,
        x=best.x,
        lam=-_flat(best.y),
        mu=_flat(best.z),
        box=_flat(best.z_box) if declared.qp.bounded else np.zeros(n),
        unique=_independent(problem, near, tight),
        mild=_mild(problem, near, tight),
        active=bool(near.any() or tight.any()),
    )


def _flat(value):
    return np.zeros(0) if value is None else np.asarray(value).ravel()


def _active_rows(problem, tight):
    rows = [np.zeros((0, problem.q.size))]
    rows += [problem.A] if problem.A is not None else []
    rows += [problem.G[tight]] if problem.G is not None else []
    return np.vstack(rows)


def _independent(problem, near, tight):
    """Whether the active rows and bounds fix their multipliers well."""
    stacked = np.vstack([np.eye(near.size)[near], _active_rows(problem, tight)])
    if not 0 < len(stacked) <= near.size:
        return len(stacked) == 0
    return bool(np.linalg.svd(stacked, compute_uv=False)[-1] > 1e-2)


def _mild(problem, near, tight):
    curvature = np.linalg.eigvalsh(problem.P)
    values = np.linalg.svd(_active_rows(problem, tight)[:, ~near], compute_uv=False)
    weak = values[values > 1e-9]  # a zero row of a planar arm asks for nothing
    level = curvature[0] > 0.03 and curvature[-1] < 30.0
    return bool(level and weak.min(initial=1.0) > 0.03)
