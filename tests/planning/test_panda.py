"""The Panda: a MotionBenchMaker problem of each family, and thin shelves."""

from pathlib import Path

import pytest

from rrnn_opt.planning import Problem, RandomRnn, plan

FAMILIES = sorted((Path(__file__).parents[1] / "data" / "mbm").glob("*.json"))


def test_every_family_is_here():
    assert len(FAMILIES) == 5


@pytest.mark.parametrize("path", FAMILIES, ids=lambda p: p.stem)
def test_family(path):
    problem = Problem.load(path)
    result = plan(problem, seed=0)
    assert result.status == "solved", result.message
    assert result.trajectory["q"][-1] == problem.goals[0].joints.tolist()


def thin_shelf() -> list[dict]:
    """Four boards of 1 cm, 14 cm apart, between sides and a back."""
    gap, wide, deep = 0.14, 0.4, 0.3
    parts = {
        f"board {k}": (0.77, 0.0, 0.2 + k * gap, deep, wide, 0.01) for k in range(4)
    }
    middle, high = 0.2 + 1.5 * gap, 4 * gap
    parts["left"] = (0.77, wide / 2, middle, deep, 0.01, high)
    parts["right"] = (0.77, -wide / 2, middle, deep, 0.01, high)
    parts["back"] = (0.62 + deep, 0.0, middle, 0.01, wide, high)
    return [
        {"name": name, "type": "box", "position": part[:3], "size": part[3:]}
        for name, part in parts.items()
    ]


@pytest.mark.parametrize("across", [0.16, -0.12])
def test_few_postures_are_free_between_thin_boards(across):
    """One in some thousand postures of the inverse kinematics is: it is found."""
    document = {
        "robot": "panda",
        "start": [0, -0.785, 0, -2.356, 0, 1.571, 0.785],
        "goal": {"position": [0.72, across, 0.55]},
        "obstacles": thin_shelf(),
    }
    problem = Problem.from_dict(document)
    few = plan(problem, settings=RandomRnn(ik_tries=500))
    assert few.status == "no_goal_posture"
    assert "no proof" in few.message
    assert plan(problem).solved
