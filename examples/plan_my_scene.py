"""A problem written in Python: Panda, a shelf board, a goal under it."""

import numpy as np

import rrnn_opt as rr

problem = rr.Problem.from_dict(
    {
        "robot": "panda",
        "start": [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785],
        "goal": {"position": [0.55, 0.1, 0.25], "tolerance": 0.001},
        "obstacles": [
            {
                "name": "board",
                "type": "box",
                "size": [0.3, 0.8, 0.02],
                "position": [0.55, 0.0, 0.45],
            },
            {
                "name": "post",
                "type": "cylinder",
                "radius": 0.04,
                "length": 0.9,
                "position": [0.45, -0.35, 0.45],
            },
        ],
        "margin": 0.005,
    }
)
result = rr.plan(problem, seed=0)
print(result.status, "-", result.message)
print("proved clearance [m]", result.certificate["clearance_lower_bound"])
print("duration [s]", np.round(result.trajectory["duration"], 3))
