"""Random solids, their supporting planes, and what coal says of them."""

import itertools

import coal
import numpy as np

from rrnn_opt.scene import (
    KINDS,
    Box,
    Capsule,
    Cylinder,
    HalfSpace,
    Sphere,
    distance_function,
)

FUNCTIONS = {kind: distance_function(kind) for kind in KINDS}


def a_shape(kind, rng):
    def size(*n):
        return np.exp(rng.uniform(np.log(0.02), np.log(2.0), n))

    position = rng.uniform(-1, 1, 3)
    quat = rng.normal(size=4)
    quat /= np.linalg.norm(quat)
    if kind == "box":
        return Box("o", size(3), position, quat)
    if kind == "cylinder":
        return Cylinder("o", float(size()), float(size()), position, quat)
    if kind == "capsule":
        return Capsule("o", float(size()), float(size()), position, quat)
    if kind == "sphere":
        return Sphere("o", float(size()), position)
    normal = rng.normal(size=3)
    return HalfSpace("o", normal / np.linalg.norm(normal), rng.uniform(-1, 1))


def evaluate(shape, p):
    d, n = FUNCTIONS[shape.kind](p, shape.pack())
    return float(d), np.array(n).ravel()


def support(shape, n):
    """Largest n.x over the solid, in closed form (infinite for half-spaces)."""
    local = shape.rotation.T @ n
    if shape.kind == "box":
        reach = 0.5 * shape.size @ np.abs(local)
    elif shape.kind == "cylinder":
        reach = shape.radius * np.hypot(*local[:2]) + 0.5 * shape.length * abs(local[2])
    elif shape.kind == "capsule":
        reach = shape.radius + 0.5 * shape.length * abs(local[2])
    else:
        reach = shape.radius
    return n @ shape.position + reach


def special_points(shape):
    """Centres, axes, faces, edges and corners, in world axes."""
    if shape.kind == "halfspace":
        local = itertools.product((-1.0, 0.0, 1.0), repeat=3)
        return [shape.rotation @ p + shape.offset * shape.normal for p in local]
    dims = shape.pack()[12:15]
    half = {
        "box": dims,
        "cylinder": dims[[0, 0, 1]],
        "capsule": dims[[0, 0, 1]],
        "sphere": dims[[0, 0, 0]],
    }[shape.kind]
    steps = (-2.0, -1.0, -1e-12, -5e-324, 0.0, 1e-300, 1e-17, 0.5, 1.0, 1.0 + 1e-15)
    return [
        shape.rotation @ (np.array(k) * half) + shape.position
        for k in itertools.product(steps, repeat=3)
    ]


def coal_of(shape):
    where = coal.Transform3s(shape.rotation, shape.position)
    if shape.kind == "box":
        return coal.Box(*shape.size), where
    if shape.kind == "cylinder":
        return coal.Cylinder(shape.radius, shape.length), where
    if shape.kind == "capsule":
        return coal.Capsule(shape.radius, shape.length), where
    if shape.kind == "sphere":
        return coal.Sphere(shape.radius), where
    identity = coal.Transform3s(np.eye(3), np.zeros(3))
    return coal.Halfspace(shape.normal, shape.offset), identity


def coal_distance(shape, p, radius):
    geometry, where = coal_of(shape)
    result = coal.DistanceResult()
    at = coal.Transform3s(np.eye(3), p)
    d = coal.distance(
        coal.Sphere(radius), at, geometry, where, coal.DistanceRequest(), result
    )
    return d, -np.array(result.normal)


def points_around(shape, rng):
    """A point within one and a half times the solid's own bounding box."""
    if shape.kind == "halfspace":
        return rng.uniform(-1.5, 1.5, 3)
    dims = shape.pack()[12:15]
    half = {"box": dims, "cylinder": dims[[0, 0, 1]], "sphere": dims[[0, 0, 0]]}.get(
        shape.kind, dims[[0, 0, 1]] + [0, 0, dims[0]]
    )
    return shape.rotation @ (rng.uniform(-1.5, 1.5, 3) * half) + shape.position
