"""Obstacles as data, and their distance to a point, written once in SX."""

from rrnn_opt.scene.distance import PRIMITIVES, distance_function
from rrnn_opt.scene.mesh import Mesh
from rrnn_opt.scene.points import Points
from rrnn_opt.scene.scene import KINDS, Member, Scene
from rrnn_opt.scene.shapes import Box, Capsule, Cylinder, HalfSpace, Obstacle, Sphere

__all__ = [
    "KINDS",
    "PRIMITIVES",
    "Box",
    "Capsule",
    "Cylinder",
    "HalfSpace",
    "Member",
    "Mesh",
    "Obstacle",
    "Points",
    "Scene",
    "Sphere",
    "distance_function",
]
