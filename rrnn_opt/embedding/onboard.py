"""Planning on board: the inner loop of Algorithm 1, and the memory cell (14)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import casadi as ca

from rrnn_opt.dynamics import Euler
from rrnn_opt.embedding.options import Options
from rrnn_opt.embedding.render import template
from rrnn_opt.emit import c_function
from rrnn_opt.emit.c99 import literal
from rrnn_opt.errors import RrnnError
from rrnn_opt.formulations import joint_sign_sets
from rrnn_opt.formulations.known_obstacles import NEAREST
from rrnn_opt.networks import MemoryCell, PrimalDual
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Tape


@dataclass(frozen=True, eq=False)
class Onboard:
    """A planner small enough for a controller.

    The caller keeps the tree, draws the targets and decides by the cell; a
    rollout and the cell's next activity are one call each, without the C
    library.  Clearances are checked at every step and at no time between: a
    rollout is no proof.

    Attributes:
        kinematics: of the robot.
        points: robot spheres that are watched.
        obstacles: number of obstacle spheres, M.
        epsilon: of (17), s.
        step: of the integration, s.
        safe: clearance at and below which the sets (12) hold, m.
        cell: memory cell (14), fed with 1 after a contact and 0 otherwise.

    Raises:
        RrnnError: no point or no obstacle.

    Source:
        Li, Li, Hannaford (IEEE TII 2019), Algorithm 1, eqs. (10), (12), (14),
        (17): network (6a) on the scheme ``joint_sign_sets``.
    """

    kinematics: Kinematics
    points: Sequence[int]
    obstacles: int = 1
    epsilon: float = 0.01
    step: float = 0.002
    safe: float = 0.005
    cell: MemoryCell = field(default_factory=MemoryCell)

    def __post_init__(self) -> None:
        if not self.points or self.obstacles < 1:
            raise RrnnError("planning on board: give a point and an obstacle at least")

    def advance(self) -> ca.Function:
        """(q, u, target, obstacles) -> "next_q", "next_u", "error", "clearance".

        One Euler step of (17); error (m) and least clearance (m) are those at q.
        """
        kin = self.kinematics
        pairs = [(i, k) for i in self.points for k in range(self.obstacles)]
        form = joint_sign_sets(
            kin, contacts=[i for i, _ in pairs], epsilon=self.epsilon, safe=self.safe
        )
        law = PrimalDual(epsilon=self.epsilon)(form).step(Euler(self.step))
        given = {p.name: p.sx for p in law.parameters}
        obstacles = ca.SX.sym("obstacles", 4, self.obstacles)
        normals, gaps = self._contacts(pairs, obstacles)
        told = [given["normals"], given["clearances"]]
        (following,) = ca.substitute([law.next], told, [normals, gaps])
        error = ca.sqrt(ca.sumsqr(given["rd"] - kin.position()))
        outputs = {
            "next_q": kin.q + self.step * following,
            "next_u": following,
            "error": error,
            "clearance": ca.mmin(gaps),
        }
        return ca.Function(
            "rollout_step",
            [kin.q, law.state.sx, given["rd"], obstacles],
            [ca.densify(value) for value in outputs.values()],
            ["q", "u", "target", "obstacles"],
            list(outputs),
        )

    def _contacts(
        self, pairs: Sequence[tuple[int, int]], obstacles: ca.SX
    ) -> tuple[ca.SX, ca.SX]:
        """Normals (3, k) and clearances (k, 1) of spheres against spheres."""
        kin, normals, gaps = self.kinematics, [], []
        centres = kin.sphere_centres()
        for i, k in pairs:
            away = centres[:, i] - obstacles[:3, k]
            distance = ca.sqrt(ca.sumsqr(away))
            normals.append(away / ca.fmax(distance, NEAREST))
            radius = float(kin.robot.spheres[i].radius)
            gaps.append(distance - radius - obstacles[3, k])
        return ca.horzcat(*normals), ca.vertcat(*gaps)

    def feed(self) -> ca.Function:
        """(activity) -> the cell's next after a "hit" (I = 1) and a "miss" (I = 0)."""
        x = ca.SX.sym("activity")
        values = [self.cell.flow(x, ca.SX(stimulus)) for stimulus in (1.0, 0.0)]
        return ca.Function("feed", [x], values, ["activity"], ["hit", "miss"])


def onboard_files(
    onboard: Onboard, options: Options, words: dict[str, str]
) -> dict[str, str]:
    """Header and source of the planning module.

    Args:
        onboard: the planner.
        options: prefix and precision.
        words: of ``render.common_words``.
    """
    nv, width = onboard.kinematics.robot.nv, 4 if options.single else 8
    own = words | {
        "nv": str(nv),
        "n_obstacles": str(4 * onboard.obstacles),
        "m": str(onboard.obstacles),
        "node_bytes": str(2 * nv * width),
        "least": literal(0.98, options.real),
        "window": str(max(round(0.25 / onboard.step), 1)),
        "kernels": "\n".join(
            c_function(Tape.of(fn), name, real=options.real, compact=True)
            for fn, name in ((onboard.advance(), "roll"), (onboard.feed(), "feed"))
        ),
    }
    name = options.prefix
    return {
        f"include/{name}_plan.h": template("plan.h", own),
        f"src/{name}_plan.c": template("plan.c", own),
    }
