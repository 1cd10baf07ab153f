"""Seeded parameters for any scheme, by the names that schemes share."""

import functools

import numpy as np
import qpsolvers


def posture(kin, rng):
    """Between 30 and 70 % of every joint's range."""
    limits = kin.robot.limits
    low = np.where(np.isfinite(limits.lower), limits.lower, -2.0)
    high = np.where(np.isfinite(limits.upper), limits.upper, 2.0)
    return low + (high - low) * rng.uniform(0.3, 0.7, kin.robot.nv)


@functools.cache
def functions(kin):
    """Building them takes longer than calling them."""
    return kin.functions()


def jacobian(kin, q, kind="position"):
    name = {"position": "jacobian", "pose": "pose_jacobian"}[kind]
    return np.asarray(functions(kin)[name](q))


def jacobian_rate(kin, q, qd):
    return np.asarray(functions(kin)["jacobian_dot"](q, qd))


def tip(kin, q):
    return np.asarray(functions(kin)["position"](q)).ravel()


def centre(kin, index, q):
    """Centre of a sphere, (3,)."""
    return np.asarray(functions(kin)["sphere_centres"](q))[:, index]


def sphere_jacobian(kin, index, q):
    """By central differences of the centre: an oracle for contacts.py."""
    steps = 1e-6 * np.eye(kin.robot.nv)
    columns = [centre(kin, index, q + s) - centre(kin, index, q - s) for s in steps]
    return np.column_stack(columns) / 2e-6


def bounds10(kin, q, c=0.5):
    limits = kin.robot.limits
    low = np.maximum(-c * (q - limits.lower), -limits.velocity)
    return low, np.minimum(-c * (q - limits.upper), limits.velocity)


def unit_normals(kin, rng, k):
    """Random unit columns; in the plane of a planar arm."""
    n = rng.normal(size=(3, k))
    if kin.robot.name == "planar3":
        n[2] = 0.0
    return n / np.linalg.norm(n, axis=0)


def parameters(form, kin, seed, *, size=0.05):
    """A value for every parameter: all that is asked can be done by small u.

    Velocities, errors and accelerations of the task are images of joint
    velocities of at most ``size`` under the Jacobian.
    """
    rng = np.random.default_rng(seed)
    q, nv = posture(kin, rng), kin.robot.nv
    shapes = {s.name: s.shape for s in form.parameters}

    def image(rows):
        kind = "pose" if rows == 6 else "position"
        return jacobian(kin, q, kind) @ rng.uniform(-size, size, nv)

    given = {name: rng.uniform(0.01, 0.05, shape[0]) for name, shape in shapes.items()}
    given |= {"q": q}
    for name in shapes.keys() & {"rd_dot", "rd_ddot", "error", "e_int"}:
        scale = 0.01 if name in ("error", "e_int") else 1.0
        given[name] = scale * image(shapes[name][0])
    if "rd" in shapes:
        given["rd"] = tip(kin, q) + 0.01 * image(3)
    if "q_start" in shapes:
        given["q_start"] = q + rng.uniform(-0.1, 0.1, nv)
    if "qd" in shapes:
        given["qd"] = rng.uniform(-size, size, nv) / 10
    if "normals" in shapes:
        given["normals"] = unit_normals(kin, rng, shapes["normals"][1])
        given["clearances"] = rng.uniform(0.06, 0.2, shapes["clearances"][0])
    return given


def solve(form, given):
    """The optimum by DAQP, a solver that shares nothing with us."""
    best = qpsolvers.solve_problem(form.qp.at(**given), "daqp", primal_tol=1e-11)
    assert best.found, given
    return best.x


def data(form, given):
    """The numbers of the programme, by name."""
    problem = form.qp.at(**given)
    return {k: getattr(problem, k) for k in ("P", "q", "A", "b", "G", "h", "lb", "ub")}


def roomy(form, kin, seed, **changes):
    """Parameters at which no joint bound will be active."""
    return parameters(form, kin, seed, size=0.01) | changes
