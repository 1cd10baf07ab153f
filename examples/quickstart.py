"""From a law to its network's equilibrium, a QP for any solver, and C."""

import tempfile

import numpy as np

import rrnn_opt as rr

robot = rr.Robot.builtin("pa10")
kin = rr.Kinematics(robot)
form = rr.formulations.minimum_velocity(kin)
network = rr.networks.PrimalDual(epsilon=0.01)(form)
q, v = np.array([0.0, 0.5, 0.0, 1.0, 0.0, 0.8, 0.0]), np.array([0.1, 0.0, 0.05])
u, info = rr.settle(network, q=q, rd_dot=v)
qp = form.qp.at(q=q, rd_dot=v)
package = rr.generate(network, prefix="arm", real="float")
written = package.write(tempfile.mkdtemp())

print("joint velocity [rad/s]", np.round(u, 4))
print("KKT residual          ", f"{info.kkt_residual:.1e}")
print("multiplier of (4)     ", np.round(info.duals["equality"], 4))
print("C package in          ", written)
