"""The two Cortex-M boards that a package is measured on, and the tools it takes."""

from __future__ import annotations

import shutil
import subprocess
from dataclasses import dataclass
from importlib import resources
from typing import Final

from rrnn_opt.errors import RrnnError

COMPILER: Final = "arm-none-eabi-gcc"
EMULATOR: Final = "qemu-system-arm"
NEEDS: Final = {
    COMPILER: "gcc-arm-none-eabi libnewlib-arm-none-eabi",
    EMULATOR: "qemu-system-arm",
}
"""Program and the Debian packages that bring it."""

PLAIN: Final = (
    "-std=c99",
    "-O2",
    "-ffp-contract=off",
    "-fno-math-errno",
    "-ffunction-sections",
    "-fdata-sections",
)
SELECTS: Final = "--param=max-rtl-if-conversion-unpredictable-cost=100"
"""Lets gcc take conditional moves where it would branch around a load: fewer
instructions on the M4F, and always the same number on both."""
FLAGS: Final = (*PLAIN, SELECTS)
"""How a package is compiled when it is measured; cmake/arm-none-eabi.cmake says
the same."""


@dataclass(frozen=True)
class Board:
    """A processor and the machine by which QEMU stands for it.

    Attributes:
        name: of the target on the command line.
        flags: of the compiler that choose the processor.
        machine: of QEMU.
        hardware: widths of floating point that the processor computes itself.
    """

    name: str
    flags: tuple[str, ...]
    machine: str
    hardware: tuple[str, ...]


def _board(name: str, core: str, unit: str, machine: str, *hardware: str) -> Board:
    flags = (f"-mcpu={core}", "-mthumb", "-mfloat-abi=hard", f"-mfpu={unit}")
    return Board(name, flags, machine, hardware)


BOARDS: Final = {
    b.name: b
    for b in (
        _board("cortex-m4f", "cortex-m4", "fpv4-sp-d16", "mps2-an386", "float"),
        _board("cortex-m7", "cortex-m7", "fpv5-d16", "mps2-an500", "float", "double"),
    )
}


def missing() -> tuple[str, ...]:
    """Debian packages that have to be installed first; empty when all is there."""
    return tuple(text for tool, text in NEEDS.items() if shutil.which(tool) is None)


def require_tools() -> None:
    """Raise unless compiler and emulator are there.

    Raises:
        RrnnError: one is not; the message names the Debian packages.
    """
    if missing():
        packages = " ".join(missing())
        raise RrnnError(f"measuring a target needs `apt install {packages}`")


@dataclass(frozen=True)
class Tools:
    """Versions of what measured.

    Attributes:
        compiler: first line that the compiler says of itself.
        emulator: the same of the emulator.
    """

    compiler: str
    emulator: str

    @staticmethod
    def found() -> Tools:
        """Ask the tools."""
        require_tools()
        return Tools(_version(COMPILER), _version(EMULATOR))


def _version(tool: str) -> str:
    done = subprocess.run(
        [tool, "--version"], capture_output=True, text=True, check=True, timeout=30.0
    )
    return done.stdout.splitlines()[0]


def support(name: str) -> str:
    """Text of one file of the bare-metal support."""
    folder = resources.files("rrnn_opt.embedding") / "templates" / "target"
    return (folder / name).read_text("utf-8")
