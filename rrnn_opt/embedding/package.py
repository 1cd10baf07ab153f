"""A package as text, and how it reaches a folder without harming one."""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import re
import shutil
import time
import uuid
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rrnn_opt.arguments import checked
from rrnn_opt.embedding.words import require_prefix
from rrnn_opt.errors import RrnnError

KIND = "rrnn_opt C package"
MANIFEST = "MANIFEST.json"
STALE = 3600.0
"""Age in seconds from which a draft is nobody's any more."""
_PLAIN = re.compile(r"[A-Za-z0-9_-][A-Za-z0-9_.-]{0,99}")


@checked()
@dataclass(frozen=True)
class Package:
    """Files of a controller.

    Attributes:
        prefix: of every exported name; also the folder's name.
        files: text by relative path, MANIFEST.json among them.

    Raises:
        RrnnError: the prefix is no C name, or a path leads out of the folder.
    """

    prefix: str
    files: Mapping[str, str]

    def __post_init__(self) -> None:
        require_prefix(self.prefix)
        for path in self.files:
            if not _inside(path):
                raise RrnnError(f"{path[:80]!a} is no name of a file of a package")

    @property
    def manifest(self) -> dict[str, Any]:
        """MANIFEST.json."""
        document: dict[str, Any] = json.loads(self.files[MANIFEST])
        return document

    def write(self, out_dir: str | os.PathLike[str]) -> Path:
        """Write ``out_dir/<prefix>/``.

        A new folder appears at once and whole.  Over a package written before,
        each file is replaced whole, the manifest last, and files that it no
        longer has are removed; files of others in there are left alone.

        Args:
            out_dir: folder to write into; made when there is none.

        Returns:
            The folder of the package.

        Raises:
            RrnnError: there is something of that name that is not our package,
                or the folder cannot be written.
        """
        parent = Path(out_dir)
        target = parent / self.prefix
        draft = parent / f".{self.prefix}.{uuid.uuid4().hex}"
        try:
            stale = _require_ours(target) - set(self.files)
            _require_no_links(target, [*self.files, *stale])
            parent.mkdir(parents=True, exist_ok=True)
            _fill(draft, self.files)
            _move(draft, target, stale)
            _sweep(parent, self.prefix)
        except OSError as error:
            raise RrnnError(f"cannot write '{target}': {error}") from error
        finally:
            shutil.rmtree(draft, ignore_errors=True)
        return target


def with_manifest(
    prefix: str, files: Mapping[str, str], facts: Mapping[str, Any]
) -> Package:
    """A package of ``files`` and the manifest that lists them.

    Args:
        prefix: of every exported name.
        files: text by relative path.
        facts: what else the manifest says; no dates and no machine names.
    """
    hashes = {path: _hash(text) for path, text in sorted(files.items())}
    manifest = {"kind": KIND, "schema": 1, **facts, "files": hashes}
    text = json.dumps(manifest, indent=2, allow_nan=False) + "\n"
    return Package(prefix, {**files, MANIFEST: text})


def _hash(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def _require_ours(target: Path) -> set[str]:
    """Files that our package in ``target`` listed; empty when nothing is there."""
    if target.is_symlink() or (target.exists() and not target.is_dir()):
        raise RrnnError(f"'{target}' is not a folder; choose another --out or prefix")
    if not target.exists() or not any(target.iterdir()):
        return set()
    try:
        manifest = json.loads((target / MANIFEST).read_text("utf-8"))
        listed = set(manifest["files"]) if manifest["kind"] == KIND else None
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        listed = None
    if listed is None:
        raise RrnnError(
            f"'{target}' holds files that are not a package of ours; empty it, or"
            " choose another --out or prefix"
        )
    return {path for path in listed if _inside(path)}


def _inside(path: str) -> bool:
    """Whether a relative path of plain names stays in its folder."""
    parts = path.split("/") if isinstance(path, str) else []
    return bool(parts) and all(_PLAIN.fullmatch(part) for part in parts)


def _require_no_links(target: Path, names: Iterable[str]) -> None:
    """Refuse to write through a folder that is a link to another one.

    Raises:
        RrnnError: one is.
    """
    for name in names:
        for folder in list(Path(name).parents)[:-1]:
            if (target / folder).is_symlink():
                raise RrnnError(
                    f"'{target / folder}' is a link to another folder; remove it, or"
                    " choose another --out or prefix"
                )


def _fill(folder: Path, files: Mapping[str, str]) -> None:
    for path, text in files.items():
        place = folder / path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(text.encode())


def _sweep(parent: Path, prefix: str) -> None:
    """Remove drafts that killed runs left an hour ago or more."""
    for path in parent.glob(f".{prefix}.{'[0-9a-f]' * 32}"):
        with contextlib.suppress(OSError):
            if not path.is_symlink() and time.time() - path.stat().st_mtime > STALE:
                shutil.rmtree(path, ignore_errors=True)


def _move(draft: Path, target: Path, stale: set[str]) -> None:
    if not target.exists() or not any(target.iterdir()):
        draft.replace(target)
        return
    found = (p.relative_to(draft) for p in draft.rglob("*") if p.is_file())
    for path in sorted(found, key=lambda p: p.name == MANIFEST):
        (target / path).parent.mkdir(parents=True, exist_ok=True)
        (draft / path).replace(target / path)
    for name in stale:
        (target / name).unlink(missing_ok=True)
