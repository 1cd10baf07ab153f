"""C text in, loaded shared object out; compiled once, then taken from the cache."""

from __future__ import annotations

import contextlib
import ctypes
import hashlib
import os
import pathlib
import re
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from rrnn_opt.emit import cache
from rrnn_opt.emit.compiler import TIMEOUT, Compiler, cpu_name, find_compiler, run
from rrnn_opt.errors import CompilerError

_MAGIC = (b"\x7fELF", b"\xcf\xfa\xed\xfe", b"MZ")
"""How shared objects begin: Linux, macOS, Windows."""


@dataclass(frozen=True, slots=True)
class Built:
    """A compiled shared object.

    Attributes:
        path: the file; it lives at least as long as this process.
        cached: it was there already, nothing was compiled.
        seconds: wall time of :func:`build`, the search for a compiler included, s.
        compiler: first line of the compiler's version.
    """

    path: pathlib.Path
    cached: bool
    seconds: float
    compiler: str


def build(source: str, *, name: str, flags: Sequence[str] = ()) -> Built:
    """Compile a self-contained C99 text for this machine, or find it compiled.

    The key covers source, flags, compiler version and CPU. When the cache
    folder cannot be written or is full, the object goes to a private temporary
    folder that lives as long as this process: slower next time, never wrong.

    Args:
        source: one translation unit.
        name: start of the file's name, for people who look into the cache.
        flags: appended to :data:`rrnn_opt.emit.compiler.FLAGS`; a later flag
            wins, e.g. ``("-O3",)``.

    Raises:
        CompilerError: no compiler, it hangs, it refuses the text, or there is
            no folder at all to write to.
    """
    start = time.perf_counter()
    compiler = find_compiler()
    words = (*compiler.flags, *flags)
    key = _key(source, words, compiler)
    stem = re.sub(r"\W+", "_", name, flags=re.ASCII)[:60] or "unnamed"
    path, cached = _obtain(source, words, compiler, f"{stem}-{key}.so")
    return Built(path, cached, time.perf_counter() - start, compiler.version)


def load(built: Built | pathlib.Path) -> ctypes.CDLL:
    """Load a shared object; its names stay its own, all are resolved at once.

    Raises:
        CompilerError: the system refuses to load it.
    """
    path = built.path if isinstance(built, Built) else built
    try:
        return _Library(str(path), mode=os.RTLD_LOCAL | os.RTLD_NOW)
    except OSError as error:
        with contextlib.suppress(OSError):
            path.unlink()  # the next build makes it again
        raise CompilerError(
            f"cannot load compiled code ({error}):"
            " set RRNN_CACHE_DIR to a folder from which programs may run"
        ) from error


class _Library(ctypes.CDLL):
    """A library that names a function it lacks in an error of ours."""

    def __getitem__(self, name: Any) -> Any:
        try:
            return super().__getitem__(name)
        except AttributeError as error:
            raise CompilerError(
                f"compiled code lacks '{name}': the C compiler made something else"
                " than it was asked for; try another one by setting CC"
            ) from error


def _key(source: str, words: Sequence[str], compiler: Compiler) -> str:
    digest = hashlib.sha256()
    for part in (source, *words, *compiler.command, compiler.version, cpu_name()):
        digest.update(part.encode() + b"\0")
    return digest.hexdigest()[:32]


def _obtain(
    source: str, words: Sequence[str], compiler: Compiler, file: str
) -> tuple[pathlib.Path, bool]:
    folder = cache.cache_folder()
    for place in (folder / file, _private(file)):
        if place is not None and cache.valid(place):
            return place, True
    key = file.rpartition("-")[2]
    with cache.lock(folder, key):
        if cache.valid(folder / file):  # another process was faster
            return folder / file, True
        body = compile_text(source, words, compiler)
        try:
            cache.store(folder / file, body)
            cache.sweep(folder)
            return folder / file, False
        except OSError:
            return _store_privately(file, body), False


def _private(file: str) -> pathlib.Path | None:
    """Where this process would have kept an entry, if it ever had to."""
    if cache.private_folder.cache_info().currsize == 0:
        return None
    return cache.private_folder() / file


def _store_privately(file: str, body: bytes) -> pathlib.Path:
    path = cache.private_folder() / file
    try:
        cache.store(path, body)
    except OSError as error:
        raise CompilerError(
            f"cannot write compiled code to the cache or to {path.parent} ({error}):"
            " set RRNN_CACHE_DIR to a writable folder with free space"
        ) from error
    return path


def compile_text(
    source: str,
    words: Sequence[str],
    compiler: Compiler,
    *,
    timeout: float = TIMEOUT,
) -> bytes:
    """Bytes of the shared object that the compiler makes of this text.

    Raises:
        CompilerError: it refuses, hangs, makes no shared object, or has no room
            for its files.
    """
    try:
        with tempfile.TemporaryDirectory(prefix=cache.PREFIX) as folder:
            text, out = pathlib.Path(folder, "tu.c"), pathlib.Path(folder, "tu.so")
            text.write_text(source, encoding="utf-8")
            command = [*compiler.command, *words, str(text), "-o", str(out), "-lm"]
            code, output = run(command, timeout=timeout, env=_environment(folder))
            if code != 0:
                raise CompilerError(_refusal(code, output), command, output[:4000])
            return _object(out, command, output)
    except OSError as error:
        raise CompilerError(
            f"the C compiler has nowhere to write ({error}):"
            " set TMPDIR to a writable folder with free space"
        ) from error


def _object(out: pathlib.Path, command: list[str], output: str) -> bytes:
    """What the compiler made, if it can be a shared object at all."""
    body = out.read_bytes() if out.exists() else b""
    if not body.startswith(_MAGIC):
        raise CompilerError(
            f"the C compiler '{command[0]}' ended well but made no shared object;"
            " try another one by setting CC",
            command,
            output[:4000],
        )
    return body


def _environment(folder: str) -> dict[str, str]:
    """Keep the compiler's temporary files with us, and zig's cache with ours.

    Zig builds its start-up files once into a cache of its own: without one
    that lasts, every compilation takes ten seconds instead of a fraction.
    """
    zig = os.environ.get("ZIG_GLOBAL_CACHE_DIR") or _lasting() or f"{folder}/zig"
    return {"TMPDIR": folder, "ZIG_GLOBAL_CACHE_DIR": zig, "ZIG_LOCAL_CACHE_DIR": zig}


def _lasting() -> str | None:
    lasting = cache.cache_folder() / "zig"
    try:
        lasting.parent.mkdir(parents=True, exist_ok=True)
    except OSError:
        return None
    return str(lasting) if os.access(lasting.parent, os.W_OK) else None


def _refusal(code: int, output: str) -> str:
    lines = [line for line in output.splitlines() if "error" in line.lower()]
    first = lines[0] if lines else output.strip()[:200] or "no message"
    return f"the C compiler failed (exit status {code}): {first}"
