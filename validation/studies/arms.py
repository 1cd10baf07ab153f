"""Arms of example-robot-data that nothing was tuned on, with fitted spheres."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import asdict
from importlib import metadata
from pathlib import Path

from rrnn_opt.report import write_text
from rrnn_opt.robot import Robot
from rrnn_opt.robot.fitting.fit import fit_spheres

INFLATION, MOST = 0.02, 16
"""Wanted bulge of the spheres, m, and most spheres a mesh: the defaults."""

ARMS: dict[str, tuple[str, tuple[str, ...]]] = {
    "ur10": ("ur_description/urdf/ur10_robot.urdf", ("tool0",)),
    "xarm7": ("xarm_description/urdf/xarm7.urdf", ()),
    "kinova": ("kinova_description/robots/kinova.urdf", ()),
    "baxter": ("baxter_description/urdf/baxter.urdf", ("left_gripper",)),
    "baxter, both arms": (
        "baxter_description/urdf/baxter.urdf",
        ("left_gripper", "right_gripper"),
    ),
}
"""File of example-robot-data, and tips; none: the file's last leaf."""


def robots_folder() -> Path:
    """Where example-robot-data keeps its robots."""
    files = metadata.files("example-robot-data") or []
    panda = next(file for file in files if file.name == "panda.urdf")
    return Path(str(panda.locate())).resolve().parents[2]


def arm(name: str, out: Path) -> Robot:
    """One of ``ARMS`` with fitted spheres, which are kept in ``out``.

    Raises:
        RuntimeError: the spheres are not shown to cover the arm.
    """
    file, tips = ARMS[name]
    urdf, spheres = robots_folder() / file, out / f"{_file_name(name)}_spheres.json"
    if not spheres.is_file():
        fitted = fit_spheres(urdf, tips=tips, inflation=INFLATION, most=MOST)
        if not fitted.covered:
            raise RuntimeError(f"the spheres of {name} do not cover it")
        contact = {"before": asdict(fitted.before), "after": asdict(fitted.contact)}
        write_text(spheres, json.dumps(fitted.to_dict()))
        write_text(_contact_file(name, out), json.dumps(contact))
    return Robot.from_urdf(urdf, tips=tips, spheres=spheres)


def contacts(out: Path, names: Iterable[str]) -> dict[str, dict[str, dict[str, float]]]:
    """How often each arm's spheres, and its geometry, touch one another.

    ``SelfContact`` "before" spheres were added and "after"; arms whose spheres were
    made elsewhere are left out.
    """
    return {
        name: json.loads(_contact_file(name, out).read_text("utf-8"))
        for name in names
        if _contact_file(name, out).is_file()
    }


def _contact_file(name: str, out: Path) -> Path:
    return out / f"{_file_name(name)}_contact.json"


def _file_name(name: str) -> str:
    return name.replace(", ", "_").replace(" ", "_")
