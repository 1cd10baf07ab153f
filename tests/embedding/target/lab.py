"""A package's runner on the host and on boards: requests in, answers out."""

import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from rrnn_opt.embedding import generate
from rrnn_opt.embedding.kernel import kernel
from rrnn_opt.embedding.options import Options
from rrnn_opt.embedding.target.board import BOARDS
from rrnn_opt.embedding.target.image import compile_objects, link, run
from rrnn_opt.symbolic.interpreter import evaluate

HERE = Path(__file__).parent
WARNINGS = [
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wconversion",
    "-Wshadow",
    "-Wdouble-promotion",
    "-Wfloat-conversion",
    "-Wmissing-prototypes",
    "-Werror",
]
STATUS = (
    "OK",
    "NOT_FINITE",
    "BAD_STEP_SIZE",
    "EMPTY_LIMITS",
    "DIVERGED",
    "OUT_OF_RANGE",
    "STEP_TOO_LONG",
    "BAD_TOLERANCE",
    "INFEASIBLE",
    "NO_ANSWER",
)
RESIDUAL_LARGE, MERIT_ROSE, BOUND_ACTIVE, ROW_ACTIVE, FELL_BACK = (
    2**k for k in range(5)
)
INIT, STEP, MONITOR, VERDICT, ITERATIONS, SEEN, TICK, COUNT = range(8)
NEVER = 3e38
"""A tolerance above every residual: the fallback is not taken."""


@dataclass(frozen=True, eq=False)
class Bench:
    """One controller: its package, its kernel, its requests and answers as arrays."""

    package: object
    core: object
    options: Options

    @staticmethod
    def of(dynamics, *, network=None, **options):
        package = generate(dynamics, network=network, prefix="arm", **options)
        return Bench(package, kernel(dynamics), Options(prefix="arm", **options))

    @property
    def real(self):
        return np.float32 if self.options.single else np.float64

    @property
    def request(self):
        real, core = self.real, self.core
        inputs = [(f.name, real, (f.size,)) for f in core.inputs]
        head = [("state", real, (core.state.size,)), ("h", real), ("tolerance", real)]
        tail = [("fresh", np.uint32), ("unused", np.uint32)]
        return np.dtype([*head, *(inputs or [("none", real)]), *tail])

    @property
    def answer(self):
        real, core = self.real, self.core
        arrays = [("state", core.state.size), ("output", core.output.size), ("said", 4)]
        fields = [(name, real, (size,)) for name, size in arrays]
        return np.dtype([*fields, ("word", np.uint32, (8,))])

    def requests(self, told, *, h, tolerance=NEVER, fresh=True, state=None):
        """One request a dictionary of parameters; rounded to the package's type."""
        made = np.zeros(len(told), self.request)
        made["h"], made["tolerance"], made["fresh"] = h, tolerance, fresh
        if state is not None:
            made["state"] = state
        for k, given in enumerate(told):
            for field in self.core.inputs:
                made[k][field.name] = np.ravel(given[field.name.rstrip("_")], "F")
        return made

    def on_host(self, requests, folder, flags=("-O2",)):
        """Answers of the host's compiler, and what the runner printed."""
        place = folder / "host"
        sources = self._sources(place, HERE / "host_board.c")
        program = place / "runner"
        command = ["gcc", "-std=c99", "-ffp-contract=off", *flags, *self._defines()]
        command += [f"-I{p}" for p in self._includes(place)]
        command += [*map(str, sources), "-lm", "-o", str(program)]
        subprocess.run(command, check=True, timeout=120.0)
        requests.tofile(place / "requests.bin")
        done = subprocess.run(
            [str(program)], cwd=place, check=True, capture_output=True, text=True
        )
        return np.fromfile(place / "answers.bin", self.answer), done.stdout

    def on_board(self, name, requests, folder, flags=()):
        """Answers of an emulated board, and what the runner printed."""
        board, place = BOARDS[name], folder / name
        sources = self._sources(place)
        includes = self._includes(place)
        flags = [*self._defines(), *flags]
        objects = compile_objects(board, sources, place, includes=includes, flags=flags)
        image = link(board, objects, place / "runner.elf", includes=includes)
        requests.tofile(place / "requests.bin")
        printed = run(board, image, place)
        return np.fromfile(place / "answers.bin", self.answer), printed

    def by_tape(self, requests):
        """Next state, output, merit and residual of the network, by the interpreter."""
        names = [port.name for port in self.core.tape.outputs]
        found = {n: [] for n in ("next", "output", "merit", "residual")}
        state = None
        for row in requests:
            state = row["state"] if row["fresh"] else state
            shaped = [row[f.name].reshape(f.shape, order="F") for f in self.core.inputs]
            for _ in range(self.options.steps):
                given = [state, *shaped, np.array([row["h"]])]
                values = evaluate(self.core.tape, given, self.real)
                said = dict(zip(names, values, strict=True))
                state = np.ravel(said["next"])
            for name, values in found.items():
                values.append(np.ravel(said[name], order="F"))
        return {name: np.array(values) for name, values in found.items()}

    def _defines(self):
        header = '-DCONTROLLER_HEADER="arm.h"'
        return [header, "-DCONTROLLER=arm", "-DCONTROLLER_UPPER=ARM"]

    def _sources(self, place, *more):
        self.package.write(place)
        shutil.copy(HERE / "runner.c", place)
        return [*sorted((place / "arm" / "src").glob("*.c")), place / "runner.c", *more]

    def _includes(self, place):
        return [place / "arm" / "include", place / "arm" / "test" / "target"]
