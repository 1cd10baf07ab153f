"""Claims that come with a formulation and its network, for any robot."""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.claim import Claim
from rrnn_opt.decay import DecayClaim
from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations import position_feedback
from rrnn_opt.networks import Network, PrimalDual
from rrnn_opt.robot import Kinematics
from rrnn_opt.verification.case import ClaimCase
from rrnn_opt.verification.catalogue.motion import (
    clearance_is_kept,
    limits_are_kept,
    memory_stays_bounded,
    projection_law,
    reduced_law_decreases,
)
from rrnn_opt.verification.catalogue.optimum import equilibrium_is_optimum
from rrnn_opt.verification.catalogue.rates import euler_step, exponential_rate
from rrnn_opt.verification.composite import Proof
from rrnn_opt.verification.energy import Frozen, decrease

__all__ = [
    "claims",
    "clearance_is_kept",
    "equilibrium_is_optimum",
    "euler_step",
    "exponential_rate",
    "limits_are_kept",
    "memory_stays_bounded",
    "projection_law",
    "reduced_law_decreases",
]


@checked()
def claims(
    form: Formulation,
    network: Network,
    kin: Kinematics,
    *,
    contacts: Sequence[int] = (),
) -> list[ClaimCase]:
    """What is claimed of a scheme, solved by a network, on a robot.

    A claim that has no meaning for the scheme (no rows, no bounds, no contacts)
    is left out.  Those about rest points and decay are of the network (6);
    ``reduced_law_decreases`` is of ``position_feedback`` with its default settings.

    Args:
        form: the scheme.
        network: the rule that solves it.
        kin: kinematics that the scheme was made with.
        contacts: spheres of the scheme's contacts, where it has some.

    Raises:
        RrnnError: the scheme was made with other kinematics.
    """
    _require_own(form, kin)
    found: list[Claim | Proof | DecayClaim | None] = []
    if isinstance(network, PrimalDual) and not network.whiten:
        found += [equilibrium_is_optimum(form), _energy(form)]
        found += [exponential_rate(form, kin), euler_step(form, network, kin)]
    found.append(projection_law(form.decision.size) if form.qp.bounded else None)
    if form.fingerprint == position_feedback(kin).fingerprint:
        found.append(reduced_law_decreases(kin))
    found += [limits_are_kept(form, kin), clearance_is_kept(form, kin, contacts)]
    found.append(memory_stays_bounded())
    return [ClaimCase(statement) for statement in found if statement is not None]


def _require_own(form: Formulation, kin: Kinematics) -> None:
    for symbol in form.parameters:
        if symbol.name == "q" and not ca.is_equal(symbol.sx, kin.q):
            raise RrnnError(
                f"{form.name} was made with other kinematics than {kin.robot.name}'s "
                "given here: make the scheme and its claims with one Kinematics"
            )


def _energy(form: Formulation) -> Proof | None:
    """V of (6) decreases for the scheme's numbers of joints and rows."""
    rows = int(form.equalities.size1())
    if rows == 0 or form.inequalities.size1():
        return None
    return decrease(Frozen.of(form.decision.size, rows), "energy_decreases")
