"""A robot of one's own: any URDF with spheres, boxes or cylinders to collide."""

from pathlib import Path

import rrnn_opt as rr

urdf = Path(__file__).with_name("planar_arm.urdf")
robot = rr.Robot.from_urdf(urdf, tip="tip")
print("joints", robot.joint_names, "limits [rad]", robot.limits.lower)

problem = rr.Problem.from_dict(
    {
        "robot": str(urdf),
        "frame": "tip",
        "start": [1.2, 0.3],
        "goal": {"joints": [-1.2, -0.3]},
        "obstacles": [
            {
                "name": "post",
                "type": "cylinder",
                "radius": 0.05,
                "length": 1.0,
                "position": [0.75, 0.0, 0.0],
            }
        ],
    }
)
result = rr.plan(problem, seed=0)
print(result.status, "-", result.message)
print("duration [s]", round(result.trajectory["duration"], 3))
