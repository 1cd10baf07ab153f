"""Declarations, methods, sessions and compiled functions: what one has in hand.

Beside what ``arguments`` gives, arrays come as numerical code has them: sparse, read
only, in Fortran's order, as views with strides, of single precision, complex, masked,
empty, of more axes.
"""

from __future__ import annotations

import functools
import random
from collections.abc import Callable
from typing import Any

import numpy as np

from benchmarks.fuzz import mutation
from benchmarks.fuzz.arguments import attempt
from benchmarks.fuzz.judging import Entry
from benchmarks.fuzz.motion_calls import Call


def array(rng: random.Random) -> Any:
    """An array as numerical code may hold it."""
    import scipy.sparse as sparse

    n = rng.choice((0, 1, 2, 3, 3, 3, 4, 7))
    base = np.linspace(0.1, 0.9, max(n, 1) ** 2).reshape(max(n, 1), -1)
    locked = base[0].copy()
    locked.flags.writeable = False
    makers: tuple[Callable[[], Any], ...] = (
        lambda: sparse.csr_matrix(base),
        lambda: sparse.csc_matrix(base[:1]),
        lambda: locked,
        lambda: np.asfortranarray(base),
        lambda: np.repeat(base, 2, axis=0)[::2, ::-1],
        lambda: base.astype(np.float32),
        lambda: base[0].astype(np.float16),
        lambda: base[0].astype(np.longdouble),
        lambda: base.astype(complex),
        lambda: np.ma.masked_array(base[0], mask=[True] * len(base)),
        lambda: np.zeros((n, 0, 2)),
        lambda: base.reshape(1, *base.shape),
        lambda: base[:, :1],
        lambda: np.broadcast_to(np.array(0.5), (n,)),
        lambda: base[0].byteswap().view(base.dtype.newbyteorder()),
        lambda: np.array([(1.0, 2)], dtype=[("a", "f8"), ("b", "i4")]),
        lambda: [np.array([0.1]), np.array([0.1, 0.2])],
        base[0].tolist,
        functools.partial(memoryview, base[0].copy()),
    )
    return rng.choice(makers)()


def argument(rng: random.Random) -> Any:
    """An array, or anything that another call is given."""
    return array(rng) if rng.random() < 0.5 else mutation.argument(rng)


@functools.cache
def declared() -> dict[str, Call]:
    """Formulations, dynamics, functions of Lyapunov, streams."""
    return _declarations() | _made_of_a_scheme()


def _declarations() -> dict[str, Call]:
    import casadi as ca

    import rrnn_opt as rr

    u, p, x = (rr.Symbol.vector(name, 2) for name in "upx")
    flow = {"name": "d", "state": x, "parameters": (p,), "output": x.sx}
    flow |= {"residual": x.sx - p.sx, "multipliers": {}}
    scheme = {"decision": u, "parameters": (p,), "cost": ca.dot(u.sx, u.sx) / 2}
    scheme |= {"name": "f", "equalities": u.sx - p.sx, "inequalities": u.sx[0] - 1}
    scheme |= {"lower": [-1.0, -1.0], "upper": [1.0, 1.0]}
    value = rr.LyapunovFunction(ca.dot(x.sx, x.sx), x, (p,))
    decay = rr.NeuralDynamics(**flow, derivative=-x.sx)
    return {
        "Formulation": (rr.Formulation, scheme),
        "NeuralDynamics": (rr.NeuralDynamics, {**flow, "derivative": -x.sx}),
        "DiscreteDynamics": (rr.DiscreteDynamics, {**flow, "next": 0.5 * x.sx}),
        "LyapunovFunction": (
            rr.LyapunovFunction,
            {"value": ca.dot(x.sx, x.sx), "state": x, "parameters": (p,)},
        ),
        "V.derivative": (value.derivative, {"dynamics": decay}),
    }


def _made_of_a_scheme() -> dict[str, Call]:
    import rrnn_opt as rr
    from rrnn_opt import networks, solving
    from rrnn_opt.verification import catalogue

    kin = rr.Kinematics(rr.Robot.builtin("planar3"))
    form = rr.formulations.minimum_velocity(kin)
    dyn = networks.LviPdnn()(form)
    return {
        "network of a scheme": (networks.LviPdnn(), {"form": form}),
        "Kinematics": (rr.Kinematics, {"robot": rr.Robot.builtin("planar3")}),
        "slide": (rr.formulations.slide, {"kin": kin, "contacts": (0,)}),
        "SettledNetwork": (
            solving.SettledNetwork,
            {"dynamics": dyn, "mode": "warm", "tolerance": 1e-9, "name": "n"},
        ),
        "catalogue.claims": (
            catalogue.claims,
            {"form": form, "network": networks.LviPdnn(), "kin": kin},
        ),
    }


@functools.cache
def handled() -> dict[str, Call]:
    """Methods of what was made, and functions that were compiled."""
    return _programs() | _batches() | _robots_and_motions() | _solvers() | _dynamics()


def _function() -> Any:
    import casadi as ca

    q = ca.SX.sym("q", 3)
    return ca.Function("f", [q], [ca.sin(q), q.T @ q], ["q"], ["s", "n"])


def _programs() -> dict[str, Call]:
    from rrnn_opt import emit

    program = emit.compile([_function()], name="fuzzed")
    room = program.call("f", np.ones(3))
    return {
        "emit.compile": (emit.compile, {"functions": [_function()], "name": "g"}),
        "Program.call": (_positional(program.call, "f"), {"q": np.ones(3)}),
        "Program.call out": (
            lambda out: program.call("f", np.ones(3), out=out),
            {"out": room},
        ),
        "Program.bind": (
            lambda out: program.bind("f", np.ones(3), out=out)(),
            {"out": room},
        ),
        "Program.map": (
            lambda q, n: program.map("f", q, n=n),
            {"q": np.ones((4, 3)), "n": 4},
        ),
    }


def _batches() -> dict[str, Call]:
    from rrnn_opt import emit

    batch = emit.compile_batch(_function())
    return {
        "compile_batch": (emit.compile_batch, {"fn": _function(), "lanes": 4}),
        "Batch": (_positional(batch), {"q": np.zeros((3, 5))}),
        "Batch out": (
            lambda out: batch(np.zeros((3, 8)), out=out),
            {"out": batch.room(8)},
        ),
    }


def _robots_and_motions() -> dict[str, Call]:
    import rrnn_opt as rr
    from rrnn_opt import motion
    from rrnn_opt.robot.loading.restrict import restrict

    arm = rr.Robot.builtin("planar3")
    timed = motion.retime([[0.0, 0.0, 0.0], [0.1, 0.2, 0.3]], arm.limits)
    box = rr.symbolic.Box(np.zeros(3), np.ones(3))
    return {
        "Trajectory.at": (timed.at, {"t": 0.1}),
        "Trajectory.stretched": (timed.stretched, {"factor": 2.0}),
        "Trajectory.from_dict": (motion.Trajectory.from_dict, {"data": {}}),
        "Robot.frame": (arm.frame, {"name": "tip"}),
        "restrict": (restrict, {"whole": arm, "locked": {arm.joint_names[0]: 0.1}}),
        "Box.support": (box.support, {"y": [1.0, 0.0, 0.0]}),
    }


def _solvers() -> dict[str, Call]:
    import qpsolvers

    from rrnn_opt import solving

    qp = qpsolvers.Problem(np.eye(2), np.ones(2), lb=-np.ones(2), ub=np.ones(2))
    return {
        "find_farkas": (solving.find_farkas, {"problem": qp, "tolerance": 1e-9}),
        "farkas_margin": (
            solving.farkas_margin,
            {"problem": qp, "y": np.zeros(0), "z": np.zeros(0)},
        ),
        "DaqpSession": (_asked(solving.DaqpSession()), {"problem": qp}),
        "OsqpSession": (_asked(solving.OsqpSession()), {"problem": qp}),
        "ActiveSet": (_asked(solving.ActiveSet()), {"problem": qp}),
        "compare": (
            solving.compare,
            {"stream": None, "solvers": [solving.DaqpSession()], "tolerances": None},
        ),
    }


def _dynamics() -> dict[str, Call]:
    import rrnn_opt as rr
    from rrnn_opt import networks
    from rrnn_opt.lyapunov import merit

    x = rr.Symbol.vector("x", 3)
    own = rr.NeuralDynamics(
        "d", x, (), derivative=-x.sx, output=x.sx, residual=x.sx, multipliers={}
    )
    kin = rr.Kinematics(rr.Robot.builtin("planar3"))
    form = rr.formulations.minimum_velocity(kin)
    return {
        "dynamics.step": (own.step, {"method": rr.Euler(0.1)}),
        "merit": (merit, {"dynamics": networks.LviPdnn()(form)}),
    }


def _positional(call: Callable[..., Any], *first: Any) -> Callable[..., Any]:
    return lambda **given: call(*first, *given.values())


def _asked(session: Any) -> Callable[..., Any]:
    from rrnn_opt import solving

    def answer(problem: Any) -> Any:
        session.setup(solving.Instance(problem))
        return session.solve()

    return answer


GROUPS = {"declarations in Python": declared, "methods and compiled code": handled}
ENTRIES = tuple(
    Entry(name, functools.partial(attempt, calls, make=argument), 2)
    for name, calls in GROUPS.items()
)
