"""How a package reaches a folder: never two packages in one, and no file of others.

A folder that is not there appears whole, by one rename.  Over an older package the
list of all files, old and new, is put in first (``UNFINISHED.json``); then the older
ones are removed, manifest and headers before all others; then the new ones are moved
in, headers and manifest after all others; then the list goes.  Whenever that ends
early there is no manifest, no compiler finds the headers, and the next writing knows
by the list which files to take away.
"""

from __future__ import annotations

import contextlib
import json
import os
import re
import shutil
import time
import uuid
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, NoReturn

from rrnn_opt.errors import RrnnError

try:
    import fcntl
except ImportError:  # pragma: no cover - only POSIX has file locks of this kind
    fcntl = None  # type: ignore[assignment]

KIND = "rrnn_opt C package"
MANIFEST = "MANIFEST.json"
UNFINISHED = "UNFINISHED.json"
"""There while a package is written over an older one."""
STALE = 3600.0
"""Age in seconds from which a draft is nobody's any more."""
PATIENCE = 10.0
"""Seconds that another process may take to write its package."""
_PLAIN = re.compile(r"[A-Za-z0-9_-][A-Za-z0-9_.-]{0,99}")


def inside(path: str) -> bool:
    """Whether a relative path of plain names stays in its folder."""
    parts = path.split("/") if isinstance(path, str) else []
    return bool(parts) and all(_PLAIN.fullmatch(part) for part in parts)


def place(files: Mapping[str, str], target: Path) -> None:
    """Make ``target`` hold these files, and those of others that it held.

    Args:
        files: text by relative path, the manifest among them.
        target: folder of the package.

    Raises:
        RrnnError: something of that name is not our package, or leads elsewhere.
        OSError: the folder cannot be written.
    """
    parent = target.parent
    draft = parent / f".{target.name}.{uuid.uuid4().hex}"
    parent.mkdir(parents=True, exist_ok=True)
    try:
        with _alone(parent):
            older = _ours(target)
            _require_plain(target, {*files, *older})
            _fill(draft, files)
            _move(draft, target, older)
            _sweep(target)
    finally:
        shutil.rmtree(draft, ignore_errors=True)


@contextlib.contextmanager
def _alone(folder: Path) -> Iterator[None]:
    """Let one process at a time write packages into a folder, where locks are had.

    The folder itself is locked, so that no file is left; a dead process holds none.

    Raises:
        RrnnError: another process has been writing for ``PATIENCE``.
    """
    with contextlib.ExitStack() as stack:
        if fcntl is not None:
            handle = os.open(folder, os.O_RDONLY)
            stack.callback(os.close, handle)
            _wait_for(handle, folder)
        yield


def _wait_for(handle: int, folder: Path) -> None:
    """Take a lock; go on without it on file systems that know none."""
    end = time.monotonic() + PATIENCE
    while True:
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            if time.monotonic() > end:
                raise RrnnError(
                    f"another process writes packages into '{folder}'; end it, or"
                    " choose another --out"
                ) from None
            time.sleep(0.01)
        except OSError:
            return
        else:
            return


def _ours(target: Path) -> set[str]:
    """Files that our package in ``target`` listed; empty when nothing is there.

    Raises:
        RrnnError: what is there is no package of ours.
    """
    if target.is_symlink() or (target.exists() and not target.is_dir()):
        raise RrnnError(f"'{target}' is not a folder; choose another --out or prefix")
    if not target.exists() or not any(target.iterdir()):
        return set()
    lists = [_listed(target / name) for name in (MANIFEST, UNFINISHED)]
    if lists == [None, None]:
        raise RrnnError(
            f"'{target}' holds files that are not a package of ours; empty it, or"
            " choose another --out or prefix"
        )
    return {path for found in lists for path in found or () if inside(path)}


def _listed(path: Path) -> set[Any] | None:
    """What a manifest, or the list of an unfinished writing, names as ours."""
    try:
        manifest = json.loads(path.read_text("utf-8"))
        return set(manifest["files"]) if manifest["kind"] == KIND else None
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return None


def _require_plain(target: Path, names: Iterable[str]) -> None:
    """Refuse, before anything is removed, what files cannot be written through.

    Raises:
        RrnnError: a folder is a link to another one, or stands where a file
            belongs, or a file where a folder does.
    """
    for name in names:
        for folder in list(Path(name).parents)[:-1]:
            if (target / folder).is_symlink():
                _refuse(target / folder, "is a link to another folder")
            if (target / folder).exists() and not (target / folder).is_dir():
                _refuse(target / folder, "is a file where a folder belongs")
        if (target / name).is_dir() and not (target / name).is_symlink():
            _refuse(target / name, "is a folder where a file belongs")


def _refuse(path: Path, what: str) -> NoReturn:
    raise RrnnError(f"'{path}' {what}; remove it, or choose another --out or prefix")


def _fill(folder: Path, files: Mapping[str, str]) -> None:
    for path, text in files.items():
        file = folder / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(text.encode())


def _move(draft: Path, target: Path, older: set[str]) -> None:
    if not target.exists() or not any(target.iterdir()):
        draft.replace(target)
        return
    found = [p for p in draft.rglob("*") if p.is_file()]
    names = {p.relative_to(draft).as_posix() for p in found}
    (draft / UNFINISHED).write_text(_unfinished(names | older), encoding="utf-8")
    (draft / UNFINISHED).replace(target / UNFINISHED)
    for name in sorted({*older, MANIFEST}, key=_rank):
        (target / name).unlink(missing_ok=True)
    for name in sorted(names, key=_rank, reverse=True):
        (target / name).parent.mkdir(parents=True, exist_ok=True)
        (draft / name).replace(target / name)
    (target / UNFINISHED).unlink()


def _unfinished(names: set[str]) -> str:
    said = "this package was not written to its end: generate it again"
    document = {"kind": KIND, "unfinished": said, "files": sorted(names)}
    return json.dumps(document, indent=2) + "\n"


def _rank(name: str) -> tuple[bool, bool, str]:
    """What is removed first and comes last: manifest, then headers."""
    return name != MANIFEST, not name.endswith(".h"), name


def _sweep(target: Path) -> None:
    """Remove drafts that killed runs left an hour ago or more."""
    for path in target.parent.glob(f".{target.name}.{'[0-9a-f]' * 32}"):
        with contextlib.suppress(OSError):
            if not path.is_symlink() and time.time() - path.stat().st_mtime > STALE:
                shutil.rmtree(path, ignore_errors=True)
