"""Build, run and weigh the codes; one row each."""

from __future__ import annotations

import shutil
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks.embedded import law
from benchmarks.embedded.codes import C, Code, Maker
from rrnn_opt.embedding.target.board import PLAIN, Board, support
from rrnn_opt.embedding.target.image import compile_objects, link, run, size


@dataclass(frozen=True)
class Cost:
    """What one code costs on one board.

    Attributes:
        name: of the code.
        real: its type.
        board: name of the board.
        flash: bytes of the least image around it.
        ram: bytes of its variables.
        stack: bytes, painted high-water mark over all requests.
        counts: instructions of every request.
        error: largest distance of its answers from the optimum, rad/s.
    """

    name: str
    real: str
    board: str
    flash: int
    ram: int
    stack: int
    counts: np.ndarray
    error: float


def cost(make: Maker, real: str, board: Board, *, repeats: int = 1) -> Cost:
    """Measure one code.

    Args:
        make: writes its sources into a folder.
        real: "float" or "double".
        board: to measure on.
        repeats: calls with each request; the last one's answer is judged.
    """
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        code = make(folder / "code", real)
        image = _image(code, real, board, folder, "count_main.c")
        _requests(folder, real, repeats)
        run(board, image, folder)
        weighed = size(_image(code, real, board, folder, "size_main.c"))
        answers = np.fromfile(folder / "answers.bin", _answer(real))
    best = np.array([case.best for case in law.cases()])
    error = np.abs(answers["u"][repeats - 1 :: repeats] - best).max()
    stack, counts = int(answers["stack"].max()), answers["count"]
    return Cost(
        code.name, real, board.name, weighed.flash, weighed.ram, stack, counts, error
    )


def _answer(real: str) -> np.dtype:
    kind = np.float32 if real == "float" else np.float64
    return np.dtype([("u", kind, (7,)), ("count", np.uint32), ("stack", np.uint32)])


def _requests(folder: Path, real: str, repeats: int) -> None:
    rows = np.repeat([case.request for case in law.cases()], repeats, axis=0)
    rows.astype(np.float32 if real == "float" else np.float64).tofile(
        folder / "requests.bin"
    )


def _image(code: Code, real: str, board: Board, folder: Path, main: str) -> Path:
    place = folder / Path(main).stem
    place.mkdir()
    (place / "board.h").write_text(support("board.h"))
    shutil.copy(C / "peer.h", place)
    shutil.copy(C / main, place)
    includes = [place, *code.includes]
    flags = [f"-DREAL={real}", *code.flags, *["-w"] * code.foreign]
    objects = compile_objects(
        board,
        [place / main, *code.sources],
        place,
        includes=includes,
        flags=flags,
        base=PLAIN,
    )
    return link(board, objects, place / "image.elf", includes=includes)
