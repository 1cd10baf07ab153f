"""Prints a constraint a line: each package at the lowest version that we declare.

Run by .ci/pythons; fails where a requirement of pyproject.toml names no such version.
"""

import re
import sys
import tomllib
from pathlib import Path

PROJECT = Path(__file__).parents[1] / "pyproject.toml"
REQUIREMENT = re.compile(r"(?P<name>[\w.-]+)>=(?P<version>[\w.]+)(;.*)?")


def lowest(requirements: list[str]) -> dict[str, str]:
    """Versions by name.

    Raises:
        SystemExit: a requirement has no lower bound, or two that differ.
    """
    found: dict[str, str] = {}
    for one in requirements:
        match = REQUIREMENT.fullmatch(one.replace(" ", ""))
        if match is None:
            sys.exit(f"pyproject.toml: {one!r} has no lower bound that can be tested")
        name, version = match["name"], match["version"]
        if found.setdefault(name, version) != version:
            sys.exit(f"pyproject.toml: {name} has two lower bounds")
    return found


def main() -> None:
    """Constraints of all that is needed at run time or by the tests."""
    project = tomllib.loads(PROJECT.read_text())["project"]
    extras = project["optional-dependencies"]
    wanted = [*project["dependencies"]]
    wanted += [
        one for name in ("viz", "verify", "study", "test") for one in extras[name]
    ]
    for name, version in sorted(lowest(wanted).items()):
        print(f"{name}=={version}")


if __name__ == "__main__":
    main()
