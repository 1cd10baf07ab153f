"""What is asked: robot, start, goals, scene and held objects, checked when built."""
