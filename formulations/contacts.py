"""Spheres of the robot near obstacles: symbols, Jacobians and rows of contacts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import casadi as ca

from rrnn_opt.formulations.slide import require_spheres, row
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol


@dataclass(frozen=True, eq=False)
class Contacts:
    """k spheres, each with the obstacle point nearest to it.

    Attributes:
        jacobians: of the spheres' centres, (3, nv) each, m/rad or 1.
        normals: outward unit normals of the obstacles, (3, k): the direction
            from the obstacle to the sphere, (r_o - o_o) / |r_o - o_o|.
        clearances: gaps between the spheres' surfaces and the obstacles, (k, 1).
        symbols: normals and clearances, the parameters; none without spheres.
    """

    jacobians: tuple[ca.SX, ...]
    normals: Symbol
    clearances: Symbol
    symbols: tuple[Symbol, ...]

    @property
    def gradients(self) -> ca.SX:
        """Gradients ``dd_i/dq = n_i'J_i`` of the clearances, (k, nv), m/rad or 1."""
        normals = ca.horzsplit(self.normals.sx)
        pairs = zip(normals, self.jacobians, strict=False)
        rows = [n.T @ J for n, J in pairs]
        return ca.vertcat(*rows) if rows else ca.SX(0, 0)


def contacts_of(kin: Kinematics, spheres: Sequence[int]) -> Contacts:
    """Contacts of the named spheres.

    Args:
        kin: kinematics of the robot.
        spheres: index of the robot's sphere in each contact; a sphere may
            stand in several.

    Raises:
        RrnnError: there is no such sphere.
    """
    require_spheres(kin, spheres)
    k = max(len(spheres), 1)
    meaning = "outward unit normals of the obstacles"
    normals = Symbol.matrix("normals", (3, k), "1", meaning)
    gaps = Symbol.vector("clearances", k, "m", "gaps between spheres and obstacles")
    jacobians = tuple(centre_jacobian(kin, index) for index in spheres)
    return Contacts(jacobians, normals, gaps, (normals, gaps) if len(spheres) else ())


def near(clearance: ca.SX, distance: float) -> ca.SX:
    """1 where ``clearance <= distance`` (m), else 0.

    The comparison itself: as a conditional, CasADi would take a factor in the
    decision inside it.
    """
    return clearance <= distance


def clearance_rows(contacts: Contacts, u: ca.SX, *, gamma: float, safe: float) -> ca.SX:
    """Rows ``-n'J_o u - gamma (d - d_safe) <= 0``, (k, 1), m/s.

    A clearance that obeys them has ``d' >= -gamma (d - d_safe)``, so it stays
    above d_safe for ever once it is, and comes back to it otherwise.
    """
    if not contacts.jacobians:
        return ca.SX(0, 1)
    return -(contacts.gradients @ u) - gamma * (contacts.clearances.sx - safe)


def centre_jacobian(kin: Kinematics, index: int) -> ca.SX:
    """Jacobian ``J_i = do_i/dq`` of a sphere's centre o_i, (3, nv), m/rad.

    Args:
        kin: kinematics of the robot.
        index: of the sphere.
    """
    tree = kin.robot.tree
    moving = tree.ancestors(kin.robot.spheres[index].joint)
    mask = ca.SX([float(j in moving) for j in range(tree.nj)])
    centre = kin.sphere_centres()[:, index]
    axes, origins = kin.axes(), kin.origins()
    unit = ca.SX.eye(3)
    rows = [row(tree, axes, origins, mask, centre, unit[:, a]) for a in range(3)]
    return ca.densify(ca.vertcat(*rows))
