"""What makes a row of a file the row of this case and no other."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable
from functools import lru_cache
from importlib import metadata
from pathlib import Path
from typing import Any

from rrnn_opt.study.cases import Case, Study, plain

PACKAGES = ("numpy", "scipy", "casadi", "qpsolvers", "osqp", "daqp", "toppra", "pin")
"""Packages whose versions enter every identity."""

SOURCES = (".py", ".c", ".h", ".json", ".toml")


def identity(study: Study, case: Case, seed: int, *, surroundings: str) -> str:
    """Digest of study, key, parameters, seed, code and versions, 32 hex digits.

    Args:
        study: by its name; what configures a case stands in its parameters.
        case: the case.
        seed: of the study.
        surroundings: of code and versions, from ``surroundings``.
    """
    parts = [study.name, case.key, plain(case.parameters), seed, surroundings]
    text = json.dumps(parts, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:32]


def surroundings(packages: Iterable[str] = PACKAGES) -> str:
    """Digest of the code of ``rrnn_opt`` and of the versions of packages."""
    return _digest([code_fingerprint(), *versions(packages).items()])


def versions(packages: Iterable[str] = PACKAGES) -> dict[str, str]:
    """Installed versions; absent packages are left out."""
    found = {}
    for name in packages:
        try:
            found[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            continue
    return found


@lru_cache(maxsize=1)
def code_fingerprint() -> str:
    """Digest of every source file of the package, by its place in it."""
    import rrnn_opt

    root = Path(rrnn_opt.__file__).parent
    digest = hashlib.sha256()
    for path in sorted(_sources(root), key=lambda p: p.relative_to(root).as_posix()):
        digest.update(path.relative_to(root).as_posix().encode())
        digest.update(hashlib.sha256(path.read_bytes()).digest())
    return digest.hexdigest()[:16]


def _sources(folder: Path) -> Iterable[Path]:
    """Source files below a folder, linked folders of the package included."""
    for path in folder.iterdir():
        if path.is_dir():
            yield from _sources(path)
        elif path.suffix in SOURCES:
            yield path


def _digest(value: Any) -> str:
    return hashlib.sha256(json.dumps(value).encode()).hexdigest()[:16]
