"""Find a C compiler and run it, with a time limit and one honest error."""

from __future__ import annotations

import functools
import importlib.util
import os
import pathlib
import platform
import shlex
import shutil
import signal
import subprocess
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rrnn_opt.errors import CompilerError

ADVICE = (
    "no C compiler found: install one with `apt install gcc`"
    " or `pip install rrnn_opt[compiler]`"
)
FLAGS = (
    "-std=c99",
    "-O2",
    "-march=native",
    "-fPIC",
    "-shared",
    "-ffp-contract=off",
    "-fno-math-errno",
    "-fvisibility=hidden",
    "-Werror=implicit-function-declaration",
)
"""Flags of every host build. No fast-math: results are defined to the bit."""
TIMEOUT = 120.0
"""Seconds after which a compiler counts as hanging."""


@dataclass(frozen=True, slots=True)
class Compiler:
    """A compiler that answered.

    Attributes:
        command: words that start it.
        version: first line of its ``--version``.
        kind: "gcc", "clang", "zig" or "cc" (unknown).
    """

    command: tuple[str, ...]
    version: str
    kind: str

    @property
    def flags(self) -> tuple[str, ...]:
        """:data:`FLAGS` and what this compiler and system need besides."""
        extra = ["-Wl,-Bsymbolic"] if sys.platform.startswith("linux") else []
        if self.kind == "zig":  # its debug default traps on undefined behaviour
            extra.append("-fno-sanitize=undefined")
        return (*FLAGS, *extra)


def find_compiler() -> Compiler:
    """First compiler that answers: ``$CC``, gcc, clang, cc, the ziglang wheel.

    Raises:
        CompilerError: none answers; the message says what to install. Also
            when ``$CC`` is set and cannot be run: the choice is then the user's.
    """
    return _find(os.environ.get("CC", ""), os.environ.get("PATH", ""), _zig())


@functools.lru_cache(maxsize=16)
def _find(chosen: str, path: str, zig: tuple[str, ...]) -> Compiler:
    if chosen.strip():
        words = _words(chosen, path)
        found = _ask(words, path) if words else None
        if found is None:
            message = (
                f"CC='{chosen}' cannot be run: correct it (quote a path with"
                " spaces), or unset CC"
            )
            raise CompilerError(message, list(words))
        return found
    for command in (("gcc",), ("clang",), ("cc",), zig):
        found = _ask(command, path) if command else None
        if found is not None:
            return found
    raise CompilerError(ADVICE)


def _words(chosen: str, path: str) -> tuple[str, ...]:
    """A program and its arguments; none when quotes do not close."""
    if shutil.which(chosen, path=path):  # a path with spaces in it
        return (chosen,)
    try:
        return tuple(shlex.split(chosen))
    except ValueError:
        return ()


def _zig() -> tuple[str, ...]:
    """Command of the compiler inside the ziglang wheel, or nothing."""
    spec = importlib.util.find_spec("ziglang")
    if spec is None or spec.origin is None:
        return ()
    binary = pathlib.Path(spec.origin).with_name("zig")
    return (str(binary), "cc") if binary.exists() else ()


def _ask(command: tuple[str, ...], path: str) -> Compiler | None:
    binary = shutil.which(command[0], path=path)
    if binary is None:
        return None
    full = (binary, *command[1:])
    try:
        code, output = run((*full, "--version"), timeout=30.0)
    except CompilerError:
        return None
    if code != 0:
        return None
    version = output.splitlines()[0] if output else "unknown"
    return Compiler(full, version, _kind(full, output))


def _kind(command: tuple[str, ...], version: str) -> str:
    if pathlib.Path(command[0]).name == "zig":
        return "zig"
    if "clang" in version:
        return "clang"
    return "gcc" if "Free Software Foundation" in version else "cc"


def run(
    command: Sequence[str],
    *,
    timeout: float = TIMEOUT,
    env: Mapping[str, str] | None = None,
) -> tuple[int, str]:
    """Run a command in a group of its own; kill the whole group when it hangs.

    Args:
        command: words.
        timeout: seconds.
        env: environment variables that replace the inherited ones of this name.

    Returns:
        Exit status and everything it printed.

    Raises:
        CompilerError: it cannot be started or does not end in time.
    """
    try:
        process = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            env={**os.environ, "LC_ALL": "C", **(env or {})},
            start_new_session=True,
        )
    except OSError as error:
        raise CompilerError(
            f"cannot start '{command[0]}': {error}", list(command)
        ) from error
    with process:
        try:
            output, _ = process.communicate(timeout=timeout)
        except subprocess.TimeoutExpired as error:
            _kill(process)
            message = (
                f"the C compiler '{command[0]}' did not end within {timeout:g} s"
                " and was stopped; try another one by setting CC"
            )
            raise CompilerError(message, list(command)) from error
        except BaseException:
            _kill(process)
            raise
    return process.returncode, output


def _kill(process: subprocess.Popen[str]) -> None:
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        process.kill()


@functools.lru_cache(maxsize=1)
def cpu_name() -> str:
    """Model and feature flags of this CPU, since ``-march=native`` uses them."""
    wanted = ("model name", "flags", "Features", "CPU part")
    lines: dict[str, str] = {}
    try:
        for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
            key, _, value = line.partition(":")
            if key.strip() in wanted:
                lines.setdefault(key.strip(), value.strip())
    except OSError:
        pass
    return f"{platform.machine()} {platform.processor()} {sorted(lines.items())}"
