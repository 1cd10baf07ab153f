"""A folder of compiled objects that survives concurrency, kills and full disks.

An entry is one file: the shared object, followed by the SHA-256 of its bytes
(the loader ignores what follows an object). It appears under its final name by
one atomic rename, so it is there whole or not at all; an entry whose digest
does not match is treated as absent and built again.
"""

from __future__ import annotations

import atexit
import contextlib
import functools
import hashlib
import os
import pathlib
import shutil
import stat
import tempfile
import time
from collections.abc import Iterator

from rrnn_opt.errors import CompilerError

try:
    import fcntl
except ImportError:  # pragma: no cover - only POSIX has file locks of this kind
    fcntl = None  # type: ignore[assignment]

_MARK = b"\nrrnn_opt sha256 "
_STALE = 3600.0  # [s]
_FORGOTTEN = 86400.0  # [s]
_POLL = 0.02  # [s]
PATIENCE = 120.0
"""Seconds that a process waits at most for another one's compilation."""
PREFIX = "rrnn_opt-"
"""Of folders in the system's temporary folder."""


def cache_folder() -> pathlib.Path:
    """``RRNN_CACHE_DIR``, else ``rrnn_opt`` in the user's cache folder.

    A user without a home has none: then it is a path where nothing can be kept.
    """
    chosen = os.environ.get("RRNN_CACHE_DIR")
    home = os.environ.get("XDG_CACHE_HOME") or "~/.cache"
    try:
        return pathlib.Path(chosen or pathlib.Path(home, "rrnn_opt")).expanduser()
    except RuntimeError:
        return pathlib.Path(os.devnull, "rrnn_opt")


@functools.lru_cache(maxsize=1)
def private_folder() -> pathlib.Path:
    """Folder of this process alone, removed at exit; used when the cache fails.

    Raises:
        CompilerError: no temporary folder can be written either.
    """
    try:
        folder = pathlib.Path(tempfile.mkdtemp(prefix=PREFIX))
    except OSError as error:
        raise CompilerError(
            f"nowhere to write compiled code ({error}):"
            " set RRNN_CACHE_DIR or TMPDIR to a writable folder"
        ) from error
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


def valid(path: pathlib.Path) -> bool:
    """Whether an entry is there and its digest matches its bytes."""
    try:
        if not stat.S_ISREG(path.stat().st_mode):  # a pipe would be waited for
            return False
        data = path.read_bytes()
    except OSError:
        return False
    body, mark, digest = data.rpartition(_MARK)
    return bool(mark) and hashlib.sha256(body).hexdigest().encode() == digest


def store(path: pathlib.Path, body: bytes) -> None:
    """Put an entry under its final name in one step.

    Raises:
        OSError: the folder cannot be written or is full; nothing is left there.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(prefix=".new-", suffix=".tmp", dir=path.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(body + _MARK + hashlib.sha256(body).hexdigest().encode())
        os.chmod(name, 0o755)
        os.replace(name, path)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(name)
        raise


@contextlib.contextmanager
def lock(folder: pathlib.Path, key: str) -> Iterator[None]:
    """Let one process at a time build the entries that share this key's start.

    The lock only saves work (ten processes compile once); where it cannot be
    had, or its holder has been stopped, each process builds for itself and the
    last rename wins. The system drops it when its holder dies.
    """
    with contextlib.ExitStack() as stack:
        if fcntl is not None:
            with contextlib.suppress(OSError):
                (folder / "locks").mkdir(parents=True, exist_ok=True)
                modes = os.O_WRONLY | os.O_CREAT | os.O_NONBLOCK
                handle = os.open(folder / "locks" / key[:2], modes, 0o666)
                stack.callback(os.close, handle)
                _wait_for(handle)
        yield


def _wait_for(handle: int) -> None:
    """Take a file's lock, or go on without it after ``PATIENCE``."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            time.sleep(_POLL)
        else:
            return


def sweep(folder: pathlib.Path) -> None:
    """Remove what killed processes left: files here, folders among the temporary.

    Nothing depends on the clock but how long they stay: a folder of a process that
    lives on is made again when it is needed.
    """
    for path in folder.glob(".new-*.tmp"):
        with contextlib.suppress(OSError):
            if time.time() - path.stat().st_mtime > _STALE:
                path.unlink()
    for path in pathlib.Path(tempfile.gettempdir()).glob(f"{PREFIX}*"):
        with contextlib.suppress(OSError):
            seen = path.lstat()
            old = time.time() - seen.st_mtime > _FORGOTTEN
            if old and stat.S_ISDIR(seen.st_mode) and seen.st_uid == os.getuid():
                shutil.rmtree(path, ignore_errors=True)
