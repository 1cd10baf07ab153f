"""Obstacles as data, and their distance to a point, written once in SX."""

from rrnn_opt.scene.shapes import (
    Box,
    Capsule,
    Cylinder,
    HalfSpace,
    Obstacle,
    Scene,
    Sphere,
)

__all__ = ["Box", "Capsule", "Cylinder", "HalfSpace", "Obstacle", "Scene", "Sphere"]
