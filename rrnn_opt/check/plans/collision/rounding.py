"""What floating point can do to a distance, derived and not assumed.

A proof needs ``bound > required`` for numbers that doubles only approximate.
This module bounds the difference for one robot, motion and solid: the *slack*,
which every proof must have to spare.  u = 2^-53, ``gamma(n) = n u / (1 - n u)``.

The model.  ``+ - * /`` and sqrt round to the nearest double, as IEEE 754
prescribes; sine and cosine are our own (:mod:`sincos`, 8 u).  All numbers of a
document are exact.  Two laws (N. J. Higham, "Accuracy and Stability of
Numerical Algorithms", 2nd ed., SIAM 2002, sections 3.1 and 3.5) carry all:

(a) a sum of products in which no term passes through more than n roundings is
    off by at most gamma(n) times the sum of the terms' absolute values, in
    whatever order it is summed, with or without fused multiply-add;
(b) hence a 3 x 3 product A B is off by gamma(3) |A|_F |B|_F <= 9 u for two
    rotations (12 u is used), and A b by gamma(3) sqrt(3) |b| <= 6 u |b|.

``GROW`` = 1 + 1e-12 > 1 + gamma(4096) turns a computed sum of products of
numbers >= 0 into an upper bound.  Underflow adds less than 1e-290 in all.

Joint values.  q(s) = c0 + c1 s + .. with dyadic s, exact; no term of c, of the
coupling or of Horner's rule passes through more than 24 roundings.  So joint
values, and each of v tau, a tau^2 / 2, j tau^3 / 6 summed, are off by at most

    V_k = gamma(24) (|offset_k| + |multiplier_k| (max |q| + A)),

A as in :func:`hermite.unit_size`; the terms sum to at most
H_k = |multiplier_k| A.  Moves h_k are enlarged by V_k where they are made.

Frames.  Placements are within 24 u of a rotation, axes within 4 u of unit
length (:mod:`model`), so the three matrices of :attr:`Model.turn_forms`
are within 40, 66 and 48 u; with sine and cosine, each off by V_k + 8 u, and
three roundings, a joint's frame in its parent's is off (Frobenius norm) by

    lambda_k = 3 V_k + 192 u                         (a slide: 24 u),
    turn_k   = turn_p (1 + lambda_k) + lambda_k + 12 u,
    axis_k   = turn_p + 48 u,
    origin_k = origin_p + (turn_p + 8 u) |t_k| + u chain_k
               [a slide: + V_k + E_k (axis_k + 3 u)],
    centre_i = origin_k + (turn_k + 6 u) |c_i| + u chain_i,

p the parent, E_k the largest |value| of a slide, chain the largest distance
from the base along the chain.

(8 u and not 6 u, as the step from the parent, a slide's extension included, is
summed first: no term of it passes through more than four roundings).

Distances are 1-Lipschitz, so a centre's error carries over as it is.  far =
largest distance of a centre from the solid's centre + its size + radius +
required.  Local coordinates in a solid (rotation R from a quaternion: 48 u;
difference 1 u, product 6 u) are off by 55 u far; a norm, or a product with a
normal and its support, adds 16 u far.  A normal is found in the solid's own axes
and turned into the world's, n = R n', which is taken as the exact direction of
the half-space: by R (48 u) and the product (6 u), n' is within 54 u of n in
those axes, so the gap along n differs by 54 u far from the one along n'.  n' is
within 64 u of unit length, n within 118 u: another 118 u far.  Together 243 u:
signed distance, and gap along a computed normal, are off by at most 256 u far.

First order.  A row entry ``n.(a x p) - n.(a x o)`` is, a and p and o within
their errors, off by

    row_ik = axis_k 2 chain_i + centre_i + origin_k + 32 u chain_i,

so the first-order terms by ``sum_k H_k (row_ik + gamma(nj + 8) lever_ik) +
V_k lever_ik``, lever = reach of a turn, 1 of a slide.  Second-order bound and
travel are sums of products >= 0 of enlarged moves and reaches: ``GROW``.  The
last subtractions round by 4 u (far + sum lever H (2 + 2 sum H)).

The slack is the sum of these, times ``GROW``; infinite if a frame's error
exceeds 1e-3 or anything is not finite, and then nothing is proved.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.check.arithmetic import sincos
from rrnn_opt.check.arithmetic.doubles import GROW, U, gamma
from rrnn_opt.check.plans import hermite
from rrnn_opt.check.plans.reading import Array
from rrnn_opt.check.plans.robot.model import Model

SOLID = 256 * U
WORST_TURN = 1e-3
TINY = 1e-290


@dataclass(frozen=True, eq=False)
class Rounding:
    """Error bounds of what is computed for one robot and motion.

    Attributes:
        values: V, (nj,), rad or m.
        sways: H, (nj,), rad or m.
        extents: E, largest joint value and more, (nj,), rad or m.
        axes: (nj,).
        origins: (nj,), m.
        centres: (ns,), m.
        chains: largest distance of each centre from the base, (ns,), m.
    """

    values: Array
    sways: Array
    extents: Array
    axes: Array
    origins: Array
    centres: Array
    chains: Array


def rounding(model: Model, t: Array, q: Array, qd: Array) -> Rounding:
    """Bounds for all configurations of a motion.

    Args:
        model: the robot.
        t: times, (n,), s.
        q: positions, (n, nv), rad or m.
        qd: velocities, (n, nv).
    """
    size = hermite.unit_size(t, q, qd)
    turns = np.abs(model.multiplier)
    extents = np.abs(model.offset)
    extents = extents + turns * (np.abs(q).max(axis=0) + size)[model.source]
    values, sways = gamma(24) * GROW * extents, GROW * turns * size[model.source]
    turn, axes, origins, chain = _frames(model, values, extents)
    on = model.carrier
    arm = np.sqrt(np.sum(model.centres**2, axis=1))
    chains = GROW * (np.append(chain, 0.0)[on] + arm)
    own = np.append(turn, 0.0)[on] + 6 * U
    centres = np.append(origins, 0.0)[on] + own * arm + U * chains
    return Rounding(values, sways, extents, axes, origins, GROW * centres, chains)


def _frames(
    model: Model, values: Array, extents: Array
) -> tuple[Array, Array, Array, Array]:
    """Errors of the joint frames, axes and origins, and the chain lengths."""
    turn, axes, origins, chain = np.zeros((4, model.nj + 1))  # last: the base
    links = GROW * np.sqrt(np.sum(model.translation**2, axis=1))
    for k, p in enumerate(model.parents):
        slide = GROW * extents[k] * model.prismatic[k]
        own = 24 * U if model.prismatic[k] else 3 * values[k] + 24 * sincos.ERROR
        turn[k] = turn[p] * (1 + own) + own + 12 * U
        axes[k] = turn[p] + 48 * U
        chain[k] = chain[p] + links[k] + slide
        origins[k] = origins[p] + (turn[p] + 8 * U) * links[k] + U * chain[k]
        if model.prismatic[k]:
            origins[k] += values[k] + slide * (axes[k] + 3 * U)
    if not np.all(turn <= WORST_TURN):
        turn[:] = np.inf
    return turn[:-1], axes[:-1], GROW * origins[:-1], chain[:-1]


def slack(errors: Rounding, spheres: NDArray[np.int64], levers: Array) -> Array:
    """Rounding errors of bounds of moving spheres, but for the solid's part.

    Args:
        errors: of the robot and motion.
        spheres: their indices, (m,).
        levers: of their joints, zero where one does not count, (nj, m), m.

    Returns:
        (m,), m; infinite where there is no finite bound.
    """
    chains, centres = errors.chains[spheres], errors.centres[spheres]
    rows = (2 * errors.axes)[:, None] * chains + errors.origins[:, None]
    rows += centres + 32 * U * chains
    rows = (rows + gamma(len(levers) + 8) * levers) * (levers > 0)
    first = errors.sways @ rows + errors.values @ levers
    moves = errors.sways @ levers * (2 + 2 * float(errors.sways.sum()))
    worst = (centres + first + 4 * U * moves) * GROW + TINY
    return np.where(np.isfinite(worst), worst, np.inf)


def solid_slack(far: Array | float) -> Array:
    """The solid's part, for the largest distance and sizes that occur, m."""
    return np.asarray((SOLID + 4 * U) * GROW * far)
