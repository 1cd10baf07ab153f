"""The page of what was measured."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import casadi as ca

from benchmarks.embedded.law import SPHERES, Case
from benchmarks.embedded.table import Cost
from rrnn_opt.embedding.target.board import BOARDS, PLAIN, SELECTS, Tools

_HEAD = """\
# What a controller costs on a microcontroller

Seven joints (Panda), a position task, limits (10), two control points (spheres
{spheres} of the robot) against one ball; {cases} seeded requests, a limit active in
{bounds} of them and a contact row in {rows}.  Made by

    python -m benchmarks.embedded --daqp DIR

with {compiler}; {emulator}; CasADi {casadi}{daqp}.
Every code is compiled with `{flags}`{selects}.

Instructions are those that QEMU counts (`-icount`) from the call of a step to its
return.  **They are not cycles**: QEMU knows no pipeline, no wait states, no cache.
Flash and RAM are those of the least linked image, start-up code included; the stack
is a painted high-water mark; DAQP's heap is not in its RAM.  *Error* is the largest
distance of an answer from the programme's optimum, rad/s: one step of a network is
not a solve, and unrelated requests are the worst that can be asked of it.

* **ours**: the emitted step: kinematics, rows, limits, one Euler step of `LviPdnn`,
  its merit V. `whitened`: equality rows whitened.
* **package**: what `rrnn generate` ships for the whitened network: input checks,
  monitor, status codes, the exact solver at hand but not taken; *every call exact*:
  the exact solver answers every call.
* **CasADi**: the same step by `Function.generate`, `casadi_real` set to the type.
* **OSQP**: its own code generator, matrices and vectors updated, eps 1e-4, warm.
* **DAQP**: set up once, updated and solved.
"""


def page(found: Sequence[Cost], cases: Sequence[Case], daqp: str) -> str:
    """All measurements as Markdown."""
    tools = Tools.found()
    head = _HEAD.format(
        spheres=" and ".join(map(str, SPHERES)),
        cases=len(cases),
        bounds=sum(case.bounds > 0 for case in cases),
        rows=sum(case.rows > 0 for case in cases),
        compiler=tools.compiler,
        emulator=tools.emulator.split(" (")[0],
        casadi=ca.__version__,
        daqp=f", DAQP {daqp}" * bool(daqp),
        flags=" ".join(PLAIN),
        selects=f", packages also with `{SELECTS}`",
    )
    return "\n".join([head, *_tables(found), *_ratios(found), ""])


def _tables(found: Sequence[Cost]) -> Iterator[str]:
    for board in BOARDS:
        for real in ("float", "double"):
            yield f"## {board}, {real}{_soft(board, real)}\n"
            yield "| code | flash B | RAM B | stack B | instructions min / mean / max |"
            yield "|---|---:|---:|---:|---:|"
            for c in found:
                if (c.board, c.real) == (board, real):
                    yield _row(c)
            yield ""
            worst = [
                f"{c.name} {c.error:.2g}"
                for c in found
                if (c.board, c.real) == (board, real)
            ]
            yield f"Error, rad/s: {'; '.join(worst)}.\n"


def _soft(board: str, real: str) -> str:
    return "" if real in BOARDS[board].hardware else " (in software)"


def _row(c: Cost) -> str:
    counts = f"{c.counts.min()} / {c.counts.mean():.0f} / {c.counts.max()}"
    return f"| {c.name} | {c.flash} | {c.ram} | {c.stack} | {counts} |"


def _ratios(found: Sequence[Cost]) -> Iterator[str]:
    """Mean instructions of peers over ours."""
    mean = {(c.name, c.board, c.real): c.counts.mean() for c in found}
    pairs = [("CasADi", "ours"), ("OSQP", "ours, package"), ("DAQP", "ours, package")]
    yield "## Mean instructions over ours\n"
    yield "| peer | ours | " + " | ".join(_columns()) + " |"
    yield "|---|---|" + "---:|" * len(_columns())
    for peer, own in pairs:
        names = sorted({c.name for c in found if c.name.startswith(peer)})
        for name in names:
            cells = [
                f"{mean[name, board, real] / mean[own, board, real]:.1f}"
                for board in BOARDS
                for real in ("float", "double")
            ]
            yield f"| {name} | {own} | " + " | ".join(cells) + " |"


def _columns() -> list[str]:
    return [f"{board} {real}" for board in BOARDS for real in ("float", "double")]
