"""``rrnn doctor``: what is installed here, and what of it really works."""

from __future__ import annotations

import argparse
import platform
import tempfile
from typing import Any

from rrnn_opt.cli.output import Output

HELP = "versions, compilers, solvers that really solve, robots found"
BASE = (
    "rrnn_opt",
    "casadi",
    "numpy",
    "scipy",
    "pin",
    "toppra",
    "matplotlib",
    "qpsolvers",
    "osqp",
    "daqp",
    "python-flint",
    "z3-solver",
)
EXTRAS = ("viser", "ziglang", "clarabel", "cvc5", "pyarrow", "distributed")
NEEDED = ("osqp", "daqp")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The command has no arguments of its own."""


def run(args: argparse.Namespace, out: Output) -> int:
    """0 when planning and comparing can work here, else 1."""
    report = examined()
    out.document(report)
    for line in _lines(report):
        out.say(line)
    return 0 if report["healthy"] else 1


def examined() -> dict[str, Any]:
    """Everything that was looked at, as plain data."""
    from qpsolvers import available_solvers

    from rrnn_opt.cli.probe import probe

    solvers = probe(sorted(available_solvers))
    compiler, cache = _compiler(), _cache()
    works = {record["name"] for record in solvers if record["solves"]}
    healthy = compiler["command"] is not None and works.issuperset(NEEDED)
    return {
        "healthy": healthy and cache["writable"],
        "python": platform.python_version(),
        "platform": platform.platform(),
        "versions": {name: _version(name) for name in BASE},
        "extras": {name: _version(name) for name in EXTRAS},
        "compiler": compiler,
        "cache": cache,
        "solvers": solvers,
        "robots": _robots(),
    }


def _version(name: str) -> str | None:
    from importlib import metadata

    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return None


def _compiler() -> dict[str, Any]:
    from rrnn_opt.emit import find_compiler
    from rrnn_opt.errors import CompilerError

    try:
        found = find_compiler()
    except CompilerError as error:
        return {"command": None, "version": None, "message": str(error)}
    return {"command": " ".join(found.command), "version": found.version, "message": ""}


def _cache() -> dict[str, Any]:
    from rrnn_opt.emit.cache import cache_folder

    try:
        folder = cache_folder()
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder) as trial:
            trial.write(b"rrnn")
    except OSError as error:
        reason = error.strerror or str(error)
        return {"folder": error.filename, "writable": False, "message": reason}
    return {"folder": str(folder), "writable": True, "message": ""}


def _robots() -> list[dict[str, Any]]:
    from rrnn_opt.errors import RrnnError
    from rrnn_opt.robot import Robot
    from rrnn_opt.robot.builtin import BUILTIN

    found = []
    for name in BUILTIN:
        try:
            robot = Robot.builtin(name)
            found.append({"name": name, "dof": robot.nv, "message": ""})
        except RrnnError as error:
            found.append({"name": name, "dof": None, "message": str(error)})
    return found


def _lines(report: dict[str, Any]) -> list[str]:
    from rrnn_opt.report import check_line, table

    versions = ", ".join(f"{k} {v or 'missing'}" for k, v in report["versions"].items())
    extras = ", ".join(f"{k} {v or '-'}" for k, v in report["extras"].items())
    compiler, cache = report["compiler"], report["cache"]
    rows = [
        (s["name"], s["solves"], s["notices_infeasible"], s["message"])
        for s in report["solvers"]
    ]
    robots = ", ".join(f"{r['name']} ({r['dof']} DoF)" for r in report["robots"])
    return [
        f"python {report['python']} on {report['platform']}",
        f"packages: {versions}",
        f"extras: {extras}",
        f"compiler: {compiler['version'] or compiler['message']}",
        f"cache: {cache['folder']}",
        f"robots: {robots}",
        table(("solver", "solves", "notices infeasible", ""), rows),
        check_line("a C compiler answers", compiler["command"] is not None),
        check_line(f"cache can be written {cache['message']}", cache["writable"]),
        *(
            check_line(f"{s['name']} solves", s["solves"])
            for s in report["solvers"]
            if s["name"] in NEEDED
        ),
    ]
