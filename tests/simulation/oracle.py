"""Signals and optima of a recorded run, worked out in numpy."""

import casadi as ca
import numpy as np
import qpsolvers

import rrnn_opt as rr
from rrnn_opt.scene import Sphere

BALL = Sphere("ball", 0.08, np.array([0.55, 0.35, 0.75]))


class Oracle:
    """Signals of a recorded run, from its positions and velocities alone."""

    def __init__(self, result, contacts=(), ball=None):
        self.run, self.kin = result, rr.Kinematics(result.robot)
        self.fn = self.kin.functions()
        self.contacts, self.ball = contacts, ball
        self.dt = result.task.control.dt
        centres = self.kin.sphere_centres()
        self.centres = ca.Function("c", [self.kin.q], [centres])

    def position(self, q):
        return np.asarray(self.fn["position"](q)).ravel()

    def gaps(self, q):
        if self.ball is None:
            k = max(len(self.contacts), 1)
            return np.full(k, 100.0), np.tile([[1.0], [0.0], [0.0]], k)
        away = np.asarray(self.centres(q))[:, self.contacts]
        away = away - self.ball.position[:, None]
        length = np.linalg.norm(away, axis=0)
        radii = [self.run.robot.spheres[i].radius for i in self.contacts]
        return length - self.ball.radius - radii, away / length

    def at(self, k, names):
        """Parameters of period k."""
        run, told = self.run, {}
        before = run.qd[k - 1] if k else np.zeros(run.robot.nv)
        level = run.level == "acceleration"
        told["q"], told["q_start"] = run.q[k], run.q[0]
        told["qd"] = run.record.velocity[k] if level else before
        told["rd"] = run.reference[k]
        t = run.t[k]
        phi = 2 * np.pi * np.sin(np.pi * t / 20.0) ** 2
        rate = np.pi**2 / 10.0 * np.sin(np.pi * t / 10.0)
        second = np.pi**3 / 100.0 * np.cos(np.pi * t / 10.0)
        plane = run.task.curve.plane
        axes = np.eye(3)[["xyz".index(a) for a in plane]]
        slope = np.array([np.sin(phi), np.cos(phi)])
        bend = np.array([np.cos(phi), -np.sin(phi)])
        told["rd_dot"] = 0.15 * rate * (slope @ axes)
        told["rd_ddot"] = 0.15 * (second * (slope @ axes) + rate**2 * (bend @ axes))
        told["e_int"] = self.dt * np.sum(run.error[:k], axis=0)
        told["clearances"], told["normals"] = self.gaps(run.q[k])
        return {name: told[name] for name in names}


def optimum(form, given):
    solution = qpsolvers.solve_problem(form.qp.at(**given), solver="daqp")
    return solution.x
