"""Bounds of distances over time boxes, in ball arithmetic."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

import flint
import numpy as np

from rrnn_opt.check.arithmetic import cubic
from rrnn_opt.check.plans.collision.against import ObstacleTarget
from rrnn_opt.check.plans.collision.itself import SelfTarget
from rrnn_opt.check.plans.collision.scene import Scene
from rrnn_opt.check.plans.collision.targets import Target
from rrnn_opt.check.plans.exact.cover import spheres
from rrnn_opt.check.plans.exact.robot import (
    PRECISION,
    Ball,
    BallPose,
    BallRobot,
    BallSolid,
    Vector,
    dot,
    exact,
    length,
)
from rrnn_opt.check.plans.motion import Motion


@dataclass(frozen=True)
class Moment:
    """The robot at the middle of one box, and its moves inside it."""

    pose: BallPose
    terms: list[Vector]
    sway: Vector


@dataclass
class BallScene:
    """Robot, solids and motion in balls.

    Args:
        robot: the robot block of a plan.
        problem: with its "obstacles".
        scene: what the double version read of them.
        motion: the rows.
    """

    robot: Any
    problem: Mapping[str, Any]
    scene: Scene
    motion: Motion
    body: BallRobot = field(init=False)
    solids: list[BallSolid] = field(init=False)
    extents: tuple[Vector, Vector] = field(init=False)

    def __post_init__(self) -> None:
        """Turn all of it into balls."""
        entries = self.problem.get("obstacles") or []
        with flint.ctx.workprec(PRECISION):
            self.body = BallRobot(self.robot, self.scene.model)
            self.solids = [BallSolid(entry) for entry in entries]
            self.extents = self._extents()

    def _cubic(self, piece: int, k: int) -> list[Ball]:
        """Coefficients of joint k's cubic over the piece's time from 0 to 1."""
        model, m = self.scene.model, self.motion
        v = int(model.source[k])
        h = Fraction(float(m.t[piece + 1])) - Fraction(float(m.t[piece]))
        rows = slice(piece, piece + 2)
        c = cubic.coefficients(h, m.q[rows, v].tolist(), m.qd[rows, v].tolist())
        scale, shift = exact(model.multiplier[k]), exact(model.offset[k])
        balls = [scale * flint.arb(flint.fmpq(a.numerator, a.denominator)) for a in c]
        return [balls[0] + shift, *balls[1:]]

    def _extents(self) -> tuple[Vector, Vector]:
        """Joint values of slides over all times, from their Bezier points."""
        low, high = [], []
        for k in range(self.scene.model.nj):
            points: list[Ball] = [flint.arb(0)]
            if self.scene.model.prismatic[k]:
                points = []
                for piece in range(len(self.motion.t) - 1):
                    a, b, c, d = self._cubic(piece, k)
                    points += [a, a + b / 3, a + (2 * b + c) / 3, a + b + c + d]
            least, most = points[0], points[0]
            for x in points[1:]:
                least, most = flint.arb.min(least, x), flint.arb.max(most, x)
            low.append(least)
            high.append(most)
        return low, high

    def moment(self, piece: int, middle: float, half: float) -> Moment:
        """Frames and moves of one box; its ends are dyadic, hence exact."""
        s, tau = exact(middle), exact(half)
        joints, terms, sway = [], [], []
        for k in range(self.scene.model.nj):
            a, b, c, d = self._cubic(piece, k)
            joints.append(a + s * (b + s * (c + s * d)))
            moves = [
                (b + s * (2 * c + 3 * s * d)) * tau,
                (c + 3 * s * d) * tau * tau,
                d * tau * tau * tau,
            ]
            terms.append(moves)
            sway.append(sum((abs(x) for x in moves), flint.arb(0)))
        return Moment(self.body.pose(joints), terms, sway)

    def bound(self, target: Target, pair: int, now: Moment) -> Ball:
        """Lower bound of a pair's distance over the whole box."""
        travel, bend, gap = self.parts(target, pair, now)
        return gap - flint.arb.min(travel, bend)

    def parts(self, target: Target, pair: int, now: Moment) -> tuple[Ball, Ball, Ball]:
        """Approach by travel, approach along n with its rest, gap at the middle.

        Raises:
            TypeError: the target is of no kind that is known here.
        """
        if isinstance(target, ObstacleTarget):
            (sphere,) = spheres(target, pair)
            point = self.body.centre(now.pose, sphere)
            solid, own = divmod(pair, len(target.movers.spheres))
            n = _proposed(target, solid, point)
            gap = self.solids[target.members[solid]].gap(point, n)
            moving = [(sphere, point, _joints(target.movers.moved[:, own]), 1)]
        elif isinstance(target, SelfTarget):
            i, j = spheres(target, pair)
            at_i, at_j = (self.body.centre(now.pose, k) for k in (i, j))
            apart = [a - b for a, b in zip(at_i, at_j, strict=True)]
            n = [exact(float(a)) for a in apart]
            gap = dot(n, apart) / length(n)
            own_i, own_j = (_joints(side.moved[:, pair]) for side in target.sides)
            moving = [(i, at_i, own_i, 1), (j, at_j, own_j, -1)]
        else:
            raise TypeError(type(target).__name__)
        travel, bend = self._approach(moving, n, now)
        return travel, bend, gap - self.radii(target, pair)

    def radii(self, target: Target, pair: int) -> Ball:
        """Radius, or sum of both, of a pair."""
        return sum((self.body.radii[i] for i in spheres(target, pair)), flint.arb(0))

    def _approach(
        self, moving: list[tuple[int, Vector, list[int], int]], n: Vector, now: Moment
    ) -> tuple[Ball, Ball]:
        """How far the pair can approach: by travel, and along n with its rest."""
        travel, rest = flint.arb(0), flint.arb(0)
        rows = [flint.arb(0)] * len(now.sway)
        for sphere, point, own, sign in moving:
            reach = self.body.reaches(sphere, *self.extents)
            before = flint.arb(0)
            for k in own:
                h = now.sway[k]
                slides = bool(self.scene.model.prismatic[k])
                lever = flint.arb(1) if slides else reach[k]
                travel += lever * h
                rest += h * lever * (2 * before + (0 if slides else h))
                before += 0 if slides else h
                rows[k] += sign * dot(n, self.body.column(now.pose, k, point))
        along = [
            sum(
                (r * term[c] for r, term in zip(rows, now.terms, strict=True)),
                flint.arb(0),
            )
            for c in range(3)
        ]
        first = sum((abs(a) for a in along), flint.arb(0)) / length(n)
        return travel, first + rest / 2


def _joints(moved: Any) -> list[int]:
    return [int(k) for k in np.flatnonzero(moved)]


def _proposed(target: ObstacleTarget, solid: int, point: Vector) -> Vector:
    """A normal by doubles, taken as the numbers that they are."""
    column = np.array([[float(x)] for x in point])
    _, n = target.solids.facing(column, np.array([solid]))
    return [exact(x) for x in n[:, 0]]
