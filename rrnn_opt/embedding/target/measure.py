"""What a package costs on a board: flash, RAM, stack, instructions."""

from __future__ import annotations

import re
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rrnn_opt.embedding.package import Package, with_manifest
from rrnn_opt.embedding.target.board import BOARDS, FLAGS, Board, Tools
from rrnn_opt.embedding.target.image import Size, compile_objects, link, run, size
from rrnn_opt.embedding.target.stack import FLAG, Stack, stack_bound
from rrnn_opt.errors import RrnnError

_RANGE = r"{}: (\d+) to (\d+)$"


@dataclass(frozen=True)
class Footprint:
    """Costs of a package on one board.

    Instructions are what QEMU counts, not cycles: it has no pipeline, no wait
    states of the flash and no cache.

    Attributes:
        board: name of the board.
        image: of ``test/target/application.c``: init and step with start-up code;
            RAM is the three structs, the stack left out.
        stack: of step, by the compiler's call graph.
        network: least and most instructions of a step without the fallback,
            over the package's cases.
        exact: the same with the fallback; None where it is never taken.
        partial_steps: most partial steps of the fallback that were seen.
        tools: what measured.
    """

    board: str
    image: Size
    stack: Stack
    network: tuple[int, int]
    exact: tuple[int, int] | None
    partial_steps: int
    tools: Tools

    def facts(self) -> dict[str, Any]:
        """The entry of MANIFEST.json."""
        return {
            "board": self.board,
            "flash_bytes": self.image.flash,
            "ram_bytes": self.image.ram,
            "stack_bytes": self.stack.bytes,
            "stack_leaves_out": sorted(self.stack.library),
            "instructions": _named(self.network),
            "instructions_with_fallback": _named(self.exact),
            "partial_steps_seen": self.partial_steps,
            "flags": list(FLAGS) + list(BOARDS[self.board].flags),
            "compiler": self.tools.compiler,
            "emulator": self.tools.emulator,
        }


def measure(package: Package, board: Board) -> Footprint:
    """Build a package for a board, run its test there and weigh its application.

    Args:
        package: the controller.
        board: one of ``BOARDS``.

    Raises:
        RrnnError: compiler or emulator are not installed, the package's test
            fails on the board, or step has no bounded stack.
        CompilerError: the package does not compile.
    """
    with tempfile.TemporaryDirectory() as name:
        folder = package.write(name)
        build = Path(name) / "build"
        build.mkdir()
        said = _tested(board, folder, build)
        graphs = [path.read_text("utf-8") for path in sorted(build.glob("*.ci"))]
        return Footprint(
            board=board.name,
            image=size(_linked(board, folder, build, "application")),
            stack=stack_bound(graphs, f"{package.prefix}_step"),
            network=_range(said, "network's step"),
            exact=_range_or_none(said, "exact solver"),
            partial_steps=int(_found(said, r"partial steps .*: (\d+)$").group(1)),
            tools=Tools.found(),
        )


def _linked(board: Board, folder: Path, build: Path, main: str) -> Path:
    includes = [folder / "include", folder / "test", folder / "test" / "target"]
    sources = [folder / "test" / "target" / f"{main}.c", *folder.glob("src/*.c")]
    objects = compile_objects(board, sources, build, includes=includes, flags=[FLAG])
    return link(board, objects, build / f"{main}.elf")


def _tested(board: Board, folder: Path, build: Path) -> str:
    return run(board, _linked(board, folder, build, "test_target"), build)


def _found(said: str, pattern: str) -> re.Match[str]:
    found = re.search(pattern, said, re.M)
    if found is None:
        raise RrnnError(f"the test on the board does not say what it counted: {said}")
    return found


def _range(said: str, what: str) -> tuple[int, int]:
    least, most = _found(said, _RANGE.format(f".*{what}")).groups()
    return int(least), int(most)


def _range_or_none(said: str, what: str) -> tuple[int, int] | None:
    least, most = _range(said, what)
    return (least, most) if least <= most else None


def _named(found: tuple[int, int] | None) -> dict[str, int] | None:
    return None if found is None else {"min": found[0], "max": found[1]}


def measured(package: Package, board: Board) -> Package:
    """The package with its footprint in MANIFEST.json.

    Args:
        package: the controller.
        board: one of ``BOARDS``.

    Raises:
        RrnnError: as for ``measure``.
        CompilerError: likewise.
    """
    facts = package.manifest
    files = {path: package.files[path] for path in facts["files"]}
    kept = {k: v for k, v in facts.items() if k not in ("kind", "schema", "files")}
    return with_manifest(
        package.prefix, files, kept | {"footprint": measure(package, board).facts()}
    )
