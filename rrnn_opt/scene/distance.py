"""Signed distance of a point to each solid, written once in SX.

Every primitive maps a point p (3, 1) in world axes and a packed shape (16, 1)
(see ``shapes``) to ``(d, n)``: d the signed Euclidean distance in metres,
negative inside, and n (3, 1) the outward unit normal in world axes.  Outside,
n points from the nearest point of the solid to p, so that the solid lies in
the half-space ``{x : n.(x - p) <= -d}``: the row that the planner slides on.
Inside, n belongs to a nearest boundary point.

The expressions use only + - * /, sqrt, fmin, fmax, fabs, comparisons and
if_else, and no branch divides by zero: centres, axes, edges and faces give a
unit vector like all other points.
"""

from __future__ import annotations

from collections.abc import Callable

import casadi as ca

from rrnn_opt.scene.shapes import PACKED
from rrnn_opt.symbolic import require_shape

TINY = 1e-18
"""Vectors shorter than this, m, have no direction of their own; its square is
still a normal number in single precision."""

Primitive = Callable[[ca.SX, ca.SX], tuple[ca.SX, ca.SX]]


def box(p: ca.SX, shape: ca.SX) -> tuple[ca.SX, ca.SX]:
    """Distance of a point to a box: the corner rule on ``a_i = |y_i| - h_i``.

    Args:
        p: point in world axes, (3, 1), m.
        shape: packed box, (16, 1).

    Returns:
        d, m, and the outward normal, (3, 1).
    """
    rotation, y = _local(p, shape)
    d, weights = _corner(ca.fabs(y) - shape[12:15])
    return d, ca.mtimes(rotation, weights * _sign(y))


def cylinder(p: ca.SX, shape: ca.SX) -> tuple[ca.SX, ca.SX]:
    """Distance of a point to a cylinder: the corner rule in its half-plane.

    With r the distance from the axis, the corner rule is applied to
    ``(r - radius, |z| - half length)``.

    Args:
        p: point in world axes, (3, 1), m.
        shape: packed cylinder, (16, 1).

    Returns:
        d, m, and the outward normal, (3, 1).
    """
    rotation, y = _local(p, shape)
    r, radial = _direction(y[:2])
    d, weights = _corner(ca.vertcat(r - shape[12], ca.fabs(y[2]) - shape[13]))
    normal = ca.vertcat(weights[0] * radial, weights[1] * _sign(y[2]))
    return d, ca.mtimes(rotation, normal)


def capsule(p: ca.SX, shape: ca.SX) -> tuple[ca.SX, ca.SX]:
    """Distance of a point to a capsule: to its segment, less the radius.

    ``d = |y - (0, 0, z)| - radius`` with z the point's, cut at half the length.

    Args:
        p: point in world axes, (3, 1), m.
        shape: packed capsule, (16, 1).

    Returns:
        d, m, and the outward normal, (3, 1).
    """
    rotation, y = _local(p, shape)
    along = ca.fmin(ca.fmax(y[2], -shape[13]), shape[13])
    length, normal = _direction(ca.vertcat(y[0], y[1], y[2] - along))
    return length - shape[12], ca.mtimes(rotation, normal)


def sphere(p: ca.SX, shape: ca.SX) -> tuple[ca.SX, ca.SX]:
    """Distance of a point to a ball, ``d = |p - centre| - radius``.

    Args:
        p: point in world axes, (3, 1), m.
        shape: packed sphere, (16, 1).

    Returns:
        d, m, and the outward normal, (3, 1).
    """
    _require(p, shape)
    length, normal = _direction(p - shape[9:12])
    return length - shape[12], normal


def halfspace(p: ca.SX, shape: ca.SX) -> tuple[ca.SX, ca.SX]:
    """Distance of a point to the solid ``{x : n.x <= offset}``.

    Args:
        p: point in world axes, (3, 1), m.
        shape: packed half-space, (16, 1).

    Returns:
        d, m, and the outward normal, (3, 1).
    """
    _require(p, shape)
    normal = shape[6:9]
    return ca.dot(normal, p) - shape[12], normal


PRIMITIVES: dict[str, Primitive] = {
    "box": box,
    "cylinder": cylinder,
    "capsule": capsule,
    "sphere": sphere,
    "halfspace": halfspace,
}
"""Distance of each kind of shape, in the order of ``KINDS``."""


def distance_function(kind: str) -> ca.Function:
    """The primitive of one kind as a CasADi function.

    Args:
        kind: one of ``KINDS``.

    Returns:
        ``distance_KIND(p[3], shape[16]) -> (d, n[3])``.

    Raises:
        KeyError: no shape is of that kind.
    """
    p, shape = ca.SX.sym("p", 3), ca.SX.sym("shape", PACKED)
    d, n = PRIMITIVES[kind](p, shape)
    return ca.Function(
        f"distance_{kind}", [p, shape], [d, n], ["p", "shape"], ["d", "n"]
    )


def _require(p: ca.SX, shape: ca.SX) -> None:
    """Raise ``ShapeError`` unless p is (3, 1) and the shape (16, 1)."""
    require_shape(p, (3, 1), "p")
    require_shape(shape, (PACKED, 1), "shape")


def _local(p: ca.SX, shape: ca.SX) -> tuple[ca.SX, ca.SX]:
    """Rotation of the shape, and the point in the shape's own axes."""
    _require(p, shape)
    rotation = ca.reshape(shape[:9], 3, 3)
    return rotation, ca.mtimes(rotation.T, p - shape[9:12])


def _sign(y: ca.SX) -> ca.SX:
    """-1 where y < 0, else 1: never zero."""
    return ca.if_else(y < 0, -1, 1)


def _direction(v: ca.SX) -> tuple[ca.SX, ca.SX]:
    """Length of v and v / length; zero and the first unit vector at v = 0."""
    first = ca.SX([1.0] + [0.0] * (v.shape[0] - 1))
    return _unit_or(v, ca.SX(0), first)


def _corner(a: ca.SX) -> tuple[ca.SX, ca.SX]:
    """Distance to the orthant ``{a <= 0}`` and its gradient's weights.

    Outside, ``|max(a, 0)|`` and the unit vector along it.  Inside, the largest
    entry (the nearest face) and the unit vector of the first entry that has it.

    Args:
        a: excess over each face, (k, 1), m.

    Returns:
        d, m, and the weights, (k, 1), of unit length and not negative.
    """
    largest = ca.mmax(a)
    taken = ca.SX(0)
    face = ca.SX.zeros(a.shape[0])
    for k in range(a.shape[0]):
        face[k] = ca.if_else(a[k] >= largest, 1 - taken, 0)
        taken = taken + face[k]
    return _unit_or(ca.fmax(a, 0), largest, face)


def _unit_or(v: ca.SX, length: ca.SX, unit: ca.SX) -> tuple[ca.SX, ca.SX]:
    """``|v|`` and ``v / |v|``, or the values given where v is shorter than TINY."""
    squared = ca.dot(v, v)
    far = squared > TINY * TINY
    divisor = ca.sqrt(ca.if_else(far, squared, 1))
    return ca.if_else(far, divisor, length), ca.if_else(far, v, unit) * (1 / divisor)
