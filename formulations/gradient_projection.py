"""Gradient projection: self-motion that carries the arm away from obstacles."""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.contacts import contacts_of
from rrnn_opt.formulations.task import follow, require_positive, tracking
from rrnn_opt.robot import Kinematics

_CITATION = (
    "A. Liegeois, IEEE Trans. Systems, Man, and Cybernetics 7(12):868-871, 1977; "
    "obstacles: A. Maciejewski, C. Klein, Int. J. Robotics Research 4(3):109-117, "
    "1985; section I of Li, Li, Hannaford, IEEE TII 15(4), 2019"
)
_NOTES = (
    "The wish is followed only as far as the task leaves room, so nothing keeps a "
    "sphere from its obstacle; and there are no limits."
)


@checked()
def gradient_projection(
    kin: Kinematics,
    *,
    contacts: Sequence[int] = (),
    gain: float = 1.0,
    influence: float = 0.15,
    frame: str | None = None,
) -> Formulation:
    """Pseudo-inverse and null-space motion, as one programme without an inverse.

        minimise    1/2 |u - u0|^2
        subject to  rd_dot - J(q) u = 0

        u0 = gain sum_i max(1 - d_i / influence, 0) J_i' n_i

    Where J has full rank the optimum is exactly the classical

        u = J# rd_dot + (I - J# J) u0,     J# = J'(J J')^-1,

    and where it has not, the same with the Moore-Penrose J# as long as rd_dot
    can be met; so no inverse has to be written out.  u0 is the descent of
    gain influence / 2 sum_i max(1 - d_i / influence, 0)^2.  Without contacts
    u0 = 0 and the scheme is the plain pseudo-inverse.

    Args:
        kin: kinematics of the robot.
        contacts: index of the robot's sphere in each contact.
        gain: of u0, rad2/(m s).
        influence: clearance from which a contact is felt, m.
        frame: the frame that follows; the tip by default.

    Returns:
        Formulation in the joint velocity ``u`` (nv,), without bounds, with
        parameters ``q`` (nv,), ``rd_dot`` (3,) and, with k contacts,
        ``normals`` (3, k) and ``clearances`` (k,).

    Raises:
        RrnnError: no such sphere; gain or influence is not positive.
        RobotError: there is no such frame.

    Source:
        Li, Li, Hannaford (IEEE TII 2019), section I, which leaves u0 open.
    """
    require_positive(gain=gain, influence=influence)
    found, wish = contacts_of(kin, contacts), ca.SX.zeros(kin.robot.nv, 1)
    if len(contacts):
        force = ca.fmax(1 - found.clearances.sx / influence, 0)
        wish = gain * (found.gradients.T @ force)
    return follow(
        kin,
        tracking(kin, frame),
        name="gradient_projection",
        wish=wish,
        parameters=found.symbols,
        citation=_CITATION,
        notes=_NOTES,
    )
