"""The codes that are compared, as C files in a folder."""

from __future__ import annotations

import shutil
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import casadi as ca
import numpy as np
import osqp
import scipy.sparse as sp

from benchmarks.embedded import law
from rrnn_opt.embedding import generate
from rrnn_opt.embedding.target.board import SELECTS
from rrnn_opt.emit import c_function, prologue

C = Path(__file__).parent / "c"


@dataclass(frozen=True)
class Code:
    """Sources of one measured code.

    Attributes:
        name: in the table.
        sources: C files, the adapter among them.
        includes: folders of headers.
        flags: for its files.
        foreign: whether its warnings are not ours to mend.
    """

    name: str
    sources: tuple[Path, ...]
    includes: tuple[Path, ...] = ()
    flags: tuple[str, ...] = ()
    foreign: bool = False


Maker = Callable[[Path, str], Code]


def ours(folder: Path, real: str, *, whiten: bool) -> Code:
    """Our emitted step, without the checks and structs of a package."""
    text = _emitted(law.step(whiten), real)
    name = "ours, whitened" if whiten else "ours"
    step = f"-DSTEP={law.STEPS[whiten]}"
    return Code(name, _placed(folder, "ours.c", {"arm.c": text}), flags=(step,))


def package(folder: Path, real: str, *, exact: bool) -> Code:
    """A generated package; ``exact``: the fallback answers every call."""
    made = generate(law.network(True), prefix="arm", real=real).write(folder)
    own = _placed(folder, "package.c", {})
    tolerance = 0.0 if exact else 1e30
    flags = (f"-DSTEP={law.STEPS[True]}", f"-DTOLERANCE={tolerance}", SELECTS)
    name = "ours, package, every call exact" if exact else "ours, package"
    sources = tuple(sorted((made / "src").glob("*.c")))
    return Code(name, (*own, *sources), (made / "include",), flags)


def casadi_output(folder: Path, real: str) -> Code:
    """The same function by ``Function.generate``."""
    options = {"casadi_real": real, "casadi_int": "int"}
    generator = ca.CodeGenerator("arm.c", options)
    generator.add(law.step(False))
    files = {"arm.c": generator.dump()}
    step = f"-DSTEP={law.STEPS[False]}"
    name = f"CasADi {ca.__version__}"
    sources = _placed(folder, "casadi.c", files)
    return Code(name, sources, flags=(step,), foreign=True)


def osqp_codegen(folder: Path, real: str) -> Code:
    """OSQP's own code generator, matrices to be updated, eps 1e-4, warm started."""
    pattern = law.stacked_rows().sparsity()
    rows, columns = pattern.row(), pattern.colind()
    ones = np.linspace(1.0, 2.0, len(rows))
    stacked = sp.csc_matrix((ones, rows, columns), shape=(12, 7))
    lower, upper = np.full(12, -1.0), np.ones(12)
    lower[:3] = upper[:3] = 0.0
    solver = osqp.OSQP()
    settings = {"eps_abs": 1e-4, "eps_rel": 0.0, "verbose": False, "max_iter": 20_000}
    solver.setup(
        sp.csc_matrix(np.eye(7)), np.zeros(7), stacked, lower, upper, **settings
    )
    made = folder / "osqp"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        solver.codegen(
            str(made),
            parameters="matrices",
            force_rewrite=True,
            use_float=real == "float",
            compile=False,
        )
    text = _emitted(law.columns_first(), real)
    own = _placed(folder, "osqp.c", {"arm_data.c": text})
    theirs = (*sorted((made / "src").glob("*.c")), made / "workspace.c")
    headers = (made, made / "inc" / "public", made / "inc" / "private")
    count = (f"-DVALUES={len(rows)}",)
    name = f"OSQP codegen {osqp.__version__}"
    return Code(name, (*own, *theirs), headers, count, foreign=True)


def daqp_source(folder: Path, real: str, *, tree: Path) -> Code:
    """DAQP from its C sources, set up once, then updated and solved."""
    text = _emitted(law.rows_first(), real)
    own = _placed(folder, "daqp.c", {"arm_data.c": text})
    theirs = []
    for source in sorted((tree / "src").glob("*.c")):
        theirs.append(folder / f"daqp_{source.name}")
        shutil.copy(source, theirs[-1])
    single = ("-DDAQP_SINGLE_PRECISION",) * (real == "float")
    return Code("DAQP", (*own, *theirs), (tree / "include",), single, foreign=True)


def _emitted(function: ca.Function, real: str) -> str:
    text = c_function(function, function.name(), real=real, static=False, compact=True)
    return prologue(real, compact=True) + "\n" + text


def _placed(folder: Path, adapter: str, files: dict[str, str]) -> tuple[Path, ...]:
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in files.items():
        (folder / name).write_text(text)
    shutil.copy(C / adapter, folder / f"adapter_{adapter}")
    return (folder / f"adapter_{adapter}", *(folder / name for name in files))
