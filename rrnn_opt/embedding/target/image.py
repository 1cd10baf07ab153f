"""Images for a board: link one, weigh it, run it in the emulator."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from rrnn_opt.embedding.target.board import (
    COMPILER,
    EMULATOR,
    FLAGS,
    Board,
    require_tools,
    support,
)
from rrnn_opt.errors import CompilerError, RrnnError

SUPPORT = ("startup.c", "board.c")
_FILES = (*SUPPORT, "board.h", "mps2.ld")
TIMEOUT = 120.0


@dataclass(frozen=True)
class Size:
    """Bytes of a linked image.

    Attributes:
        flash: code, constants and the initial values of variables.
        ram: variables, without the stack.
    """

    flash: int
    ram: int


def compile_objects(
    board: Board,
    sources: Sequence[Path],
    folder: Path,
    *,
    includes: Sequence[Path] = (),
    flags: Sequence[str] = (),
    base: Sequence[str] = FLAGS,
) -> list[Path]:
    """Compile C files to objects.

    Args:
        board: to compile for.
        sources: C files, of different names.
        folder: where the objects go.
        includes: folders of headers.
        flags: after those of the base and of the board.
        base: of all files.

    Returns:
        The objects, in the order of the sources.

    Raises:
        CompilerError: the compiler refuses a file or warns of it.
        RrnnError: the tools are not installed.
    """
    require_tools()
    objects = []
    for source in sources:
        objects.append(folder / f"{source.stem}.o")
        places = [f"-I{place}" for place in includes]
        command = [COMPILER, *base, *board.flags, *flags, *places]
        _compile([*command, "-c", str(source), "-o", str(objects[-1])])
    return objects


def link(
    board: Board,
    objects: Sequence[Path],
    image: Path,
    *,
    includes: Sequence[Path] = (),
    flags: Sequence[str] = (),
) -> Path:
    """Link objects with start-up code and board support; unused parts are dropped.

    Args:
        board: to link for.
        objects: one of them defines main.
        image: the ELF file to make; support files are written beside it.
        includes: folders of headers.
        flags: further flags.

    Returns:
        ``image``.

    Raises:
        CompilerError: the linker refuses.
    """
    beside = image.parent / "support"
    beside.mkdir(exist_ok=True)
    for name in _FILES:
        (beside / name).write_text(support(name), encoding="utf-8")
    own = compile_objects(
        board, [beside / name for name in SUPPORT], beside, includes=includes
    )
    parts = [str(part) for part in (*objects, *own)]
    script = ["-nostartfiles", "-Wl,--gc-sections", "-T", str(beside / "mps2.ld")]
    command = [COMPILER, *FLAGS, *board.flags, *flags, *script, *parts, "-lm"]
    _compile([*command, "-o", str(image)])
    return image


def size(image: Path) -> Size:
    """Flash and RAM of an image, by the sections that are loaded or reserved."""
    done = subprocess.run(
        ["arm-none-eabi-size", str(image)], capture_output=True, text=True, check=True
    )
    text, data, bss = (int(word) for word in done.stdout.splitlines()[1].split()[:3])
    return Size(flash=text + data, ram=data + bss)


def run(board: Board, image: Path, folder: Path) -> str:
    """Run an image in the emulator, every instruction counted.

    Args:
        board: to run on.
        image: ELF file.
        folder: where the image finds and leaves its files.

    Returns:
        What it printed.

    Raises:
        RrnnError: it ended with an error, or not in time.
    """
    require_tools()
    command = [EMULATOR, "-M", board.machine, "-nographic", "-monitor", "none"]
    command += ["-serial", "none", "-icount", "shift=6"]
    command += ["-semihosting-config", "enable=on,target=native"]
    command += ["-kernel", str(image.resolve())]
    try:
        done = subprocess.run(
            command,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            errors="replace",
            cwd=folder,
            timeout=TIMEOUT,
            check=False,
        )
    except subprocess.TimeoutExpired as error:
        message = f"{board.name}: the image did not end within {TIMEOUT:g} s"
        raise RrnnError(message) from error
    said = done.stdout + done.stderr
    if done.returncode != 0:
        raise RrnnError(f"{board.name}: the image ended with {done.returncode}: {said}")
    return said


def undefined_symbols(objects: Sequence[Path]) -> frozenset[str]:
    """Names that objects leave to the libraries, each other's left out."""
    done = subprocess.run(
        ["arm-none-eabi-nm", *map(str, objects)],
        capture_output=True,
        text=True,
        check=True,
    )
    pairs = re.findall(r"^(?:[0-9a-f]+)?\s+([A-Za-z]) (\S+)$", done.stdout, re.M)
    defined = {name for kind, name in pairs if kind in "TDBRVW"}
    return frozenset(name for kind, name in pairs if kind == "U") - defined


def _compile(command: list[str]) -> None:
    done = subprocess.run(
        command, capture_output=True, text=True, check=False, timeout=TIMEOUT
    )
    if done.returncode != 0 or done.stderr:
        raise CompilerError(done.stderr or "the compiler failed", command)
