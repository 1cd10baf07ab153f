"""Sign rows at contacts: no Cartesian component may go towards the obstacle."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import casadi as ca
import numpy as np

from rrnn_opt.errors import RrnnError
from rrnn_opt.formulations.contacts import Contacts, contacts_of, near
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol


@dataclass(frozen=True)
class Band:
    """Clearances between which the rows tighten.

    Attributes:
        inner: d1, m: nearer than this no approach is allowed.
        outer: d2, m: farther than this there is no row.

    Raises:
        RrnnError: not 0 <= inner < outer.
    """

    inner: float = 0.02
    outer: float = 0.1

    def __post_init__(self) -> None:
        if not 0.0 <= self.inner < self.outer < float("inf"):
            raise RrnnError(f"{self}: it must have 0 <= inner < outer")

    def share(self, clearance: ca.SX) -> ca.SX:
        """s(d) = sin^2(pi/2 x), x = (d - d1)/(d2 - d1) held within [0, 1]."""
        return ca.sin(np.pi / 2 * self._place(clearance)) ** 2

    def slope(self, clearance: ca.SX) -> ca.SX:
        """``ds/dd = pi / (2 (d2 - d1)) sin(pi x)``, 1/m; 0 at and beyond both ends."""
        width = self.outer - self.inner
        return np.pi / (2 * width) * ca.sin(np.pi * self._place(clearance))

    def _place(self, clearance: ca.SX) -> ca.SX:
        x = (clearance - self.inner) / (self.outer - self.inner)
        return ca.fmin(ca.fmax(x, 0), 1)


def sign_jacobian(contacts: Contacts) -> ca.SX:
    """J_N = -diag(sgn n) J_o of every contact, stacked, (3k, nv).

    ``J_N qd <= 0`` says that no component of the sphere's velocity goes
    against the sign of the outward normal's.

    Raises:
        RrnnError: there is no contact.
    """
    if not contacts.jacobians:
        raise RrnnError("sign rows: give at least one contact")
    normals = ca.horzsplit(contacts.normals.sx)
    pairs = zip(normals, contacts.jacobians, strict=True)
    return ca.vertcat(*[-ca.diag(ca.sign(n)) @ J for n, J in pairs])


def active(contacts: Contacts, distance: float) -> ca.SX:
    """1 for the three rows of a contact with ``d_i <= distance`` (m), (3k, 1)."""
    gaps = ca.vertsplit(contacts.clearances.sx)
    return ca.vertcat(*[ca.repmat(near(gap, distance), 3, 1) for gap in gaps])


def threefold(values: ca.SX) -> ca.SX:
    """``v -> (v_1, v_1, v_1, v_2, ..)``, from (k, 1) to (3k, 1)."""
    return ca.vertcat(*[ca.repmat(v, 3, 1) for v in ca.vertsplit(values)])


def magnitudes(k: int) -> Symbol:
    """``magnitudes``, what the rows allowed when a contact entered the band."""
    meaning = "allowed approach, x y z of each contact, stored as it came near"
    return Symbol.vector("magnitudes", 3 * k, "m/s", meaning)


def entry_magnitudes(kin: Kinematics, spheres: Sequence[int]) -> ca.Function:
    """What to store as ``magnitudes`` when a contact enters the outer distance.

    The positive part of J_N qd: the row starts where the motion already is.
    (The published trace names a helper without showing it; it may be |J_N qd|.)

    Args:
        kin: kinematics of the robot.
        spheres: as given to the scheme.

    Returns:
        Function from q, qd (nv,) and normals (3, k) to magnitudes (3k,).
    """
    contacts = contacts_of(kin, spheres)
    qd = ca.SX.sym("qd", kin.robot.nv)
    value = ca.fmax(sign_jacobian(contacts) @ qd, 0)
    inputs, names = [kin.q, qd, contacts.normals.sx], ["q", "qd", "normals"]
    return ca.Function("entry_magnitudes", inputs, [value], names, ["magnitudes"])
