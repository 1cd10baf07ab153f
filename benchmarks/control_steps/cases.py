"""Which controllers are driven: schemes, networks, robots and types of numbers."""

from __future__ import annotations

from dataclasses import dataclass

SCHEMES = (
    "minimum_velocity",
    "closed_loop",
    "joint_limit_avoidance",
    "minimum_acceleration",
    "repetitive_motion",
    "position_feedback",
    "manipulability",
    "clearance_rows",
)
NETWORKS = (
    "PrimalDual",
    "LviPdnn",
    "DualNetwork",
    "Hildreth",
    "SimplifiedLviPdnn",
    "Lvi94",
    "E47",
)
ROBOTS = ("pa10", "panda", "raven2")


@dataclass(frozen=True)
class Case:
    """One controller; ``network`` is built with its defaults."""

    robot: str
    scheme: str
    network: str
    real: str
    fallback: bool

    def __str__(self) -> str:
        solver = "with" if self.fallback else "without"
        return f"{self.scheme}, {self.network}, {self.robot}, {self.real}, {solver}"


def cases() -> list[Case]:
    """Every scheme on every robot; networks, types and fallback take turns."""
    pairs = [(robot, scheme) for robot in ROBOTS for scheme in SCHEMES]
    return [
        Case(
            robot,
            scheme,
            NETWORKS[k % len(NETWORKS)],
            ("float", "double")[(k + k // 2) % 2],
            k % 3 != 2,
        )
        for k, (robot, scheme) in enumerate(pairs)
    ]
