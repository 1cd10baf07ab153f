"""Differential inverse kinematics of pink, solved by a neural network at rest."""

from pathlib import Path

import numpy as np
import pink
import pinocchio as pin

import rrnn_opt as rr

urdf = Path(__file__).with_name("planar_arm.urdf")
model = pin.buildModelFromUrdf(str(urdf))
configuration = pink.Configuration(model, model.createData(), np.array([1.2, 0.3]))
tip = pink.FrameTask("tip", position_cost=1.0, orientation_cost=0.0)
target = configuration.get_transform_frame_to_world("tip").copy()
target.translation = target.translation + np.array([0.1, -0.1, 0.0])
tip.set_target(target)

rr.solving.register_qpsolvers()
for _ in range(40):
    velocity = pink.solve_ik(configuration, [tip], 0.05, solver="rrnn")
    configuration.integrate_inplace(velocity, 0.05)
print("error [m]", np.round(np.linalg.norm(tip.compute_error(configuration)[:3]), 6))
