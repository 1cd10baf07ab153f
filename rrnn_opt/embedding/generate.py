"""From network dynamics to a C99 package."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

from rrnn_opt.arguments import checked
from rrnn_opt.dynamics import Dynamics
from rrnn_opt.embedding import documents, render, render_source, render_tests
from rrnn_opt.embedding.build_files import build_files
from rrnn_opt.embedding.fmu import fmu
from rrnn_opt.embedding.kernel import Kernel, kernel, pose
from rrnn_opt.embedding.layouts import arduino
from rrnn_opt.embedding.manifest import claim_files, facts, robot_facts
from rrnn_opt.embedding.onboard import Onboard, onboard_files
from rrnn_opt.embedding.options import Options
from rrnn_opt.embedding.package import Package, with_manifest
from rrnn_opt.embedding.programme import Programme, programme
from rrnn_opt.embedding.step_bound import longest_step, safe_step
from rrnn_opt.embedding.target.files import target_files
from rrnn_opt.embedding.vectors import (
    SELFTEST_CASES,
    Vector,
    reference_vectors,
    tolerance,
)
from rrnn_opt.networks import Network
from rrnn_opt.robot import Kinematics, Robot
from rrnn_opt.symbolic import Tape

Layout = Literal["arduino", "fmu"]


@dataclass(frozen=True, eq=False)
class _Parts:
    """Everything that the files of a package are made from."""

    core: Kernel
    options: Options
    exact: Programme | None
    robot: Robot | None
    pose: Tape | None
    longest: float | None
    vectors: list[Vector]
    close: float
    words: dict[str, str]


@checked()
def generate(
    dynamics: Dynamics,
    *,
    network: Network | None = None,
    kinematics: Kinematics | None = None,
    row_norm: float | None = None,
    onboard: Onboard | None = None,
    layout: Sequence[Layout] = (),
    **options: Any,
) -> Package:
    """Make a C99 package of a network: ``steps`` Euler steps in one call.

    The step is x+ = x + h f(x, parameters), emitted from the same expression
    graph that is simulated and proved.  Nothing in the package depends on the
    date or the machine: the same model gives the same bytes.

    Args:
        dynamics: the network.
        network: the rule that made it; with it the package knows, for some
            networks, up to which Euler step it is safe, and refuses longer ones.
        kinematics: of the robot; with them the package offers the pose and
            Jacobian of the tip.
        row_norm: upper bound of the norm of the inequality rows for all
            parameters, as ``formulations.known_obstacles.row_bound`` gives.
        onboard: rollouts and memory cell to go with it; the robot's planner.
        layout: further layouts of the same C that the package holds:
            "arduino" (a library), "fmu" (FMI 3.0 co-simulation, as sources).
        **options: fields of ``Options``: prefix, real, steps, step_size,
            tolerance, fallback, fused, trig, target.

    Returns:
        The package; ``.write(out_dir)`` makes its folder.

    Raises:
        RrnnError: an option cannot be used.
        UnsupportedOperationError: the graph holds an operation without C text.
    """
    form = dynamics.formulation
    longest, safe = None, None
    if network is not None and form is not None:
        longest = longest_step(network, form, row_norm)
        safe = safe_step(network, form, row_norm)
    parts = _parts(dynamics, Options(**options), kinematics, longest)
    files = _sources(parts) | _tests(parts)
    files |= build_files(parts.core, parts.options, parts.words)
    files |= target_files(parts.options, parts.words)
    if onboard is not None:
        files |= onboard_files(onboard, parts.options, parts.words)
    if "arduino" in layout:
        files |= arduino(files, parts.options, parts.words)
    if "fmu" in layout:
        files |= fmu(parts.core, files, parts.options, parts.words)
    claims, certificates = claim_files(safe)
    said = facts(parts.core, parts.options, network, longest)
    said |= {
        "robot": robot_facts(parts.robot),
        "claims": claims,
        "rounding": _rounding(parts),
    }
    every = files | _documents(parts) | certificates
    return with_manifest(parts.options.prefix, every, said)


def _parts(
    dynamics: Dynamics,
    options: Options,
    kinematics: Kinematics | None,
    longest: float | None,
) -> _Parts:
    core = kernel(dynamics)
    exact = programme(dynamics) if options.fallback else None
    options = options.below(longest)
    vectors = reference_vectors(core, options)
    return _Parts(
        core=core,
        options=options,
        exact=exact,
        robot=None if kinematics is None else kinematics.robot,
        pose=None if kinematics is None else pose(kinematics),
        longest=longest,
        vectors=vectors,
        close=tolerance(core, options, vectors),
        words=render.common_words(core, options, exact, longest),
    )


def _documents(parts: _Parts) -> dict[str, str]:
    return {
        "README.md": documents.readme(
            *(parts.core, parts.words, parts.options),
            *(parts.close, parts.exact, parts.longest),
            parts.robot,
        ),
        "MISRA.md": documents.misra(parts.words),
        "LICENSE": render.verbatim("APACHE-2.0.md"),
    }


def _rounding(parts: _Parts) -> dict[str, Any]:
    return {
        "defined_to_the_bit": parts.options.exact,
        "stated_error": parts.close,
        "measured_on_cases": len(parts.vectors),
        "against": "CasADi in double precision, relative to the larger of 1 and x",
    }


def _sources(parts: _Parts) -> dict[str, str]:
    core, options, words = parts.core, parts.options, parts.words
    name = options.prefix
    body = render_source.source(
        core, options, words, parts.exact, parts.longest, parts.pose
    )
    few = parts.vectors[:SELFTEST_CASES]
    files = {
        f"include/{name}.h": render_source.header(core, options, words, parts.pose),
        f"src/{name}.c": body,
        f"src/{name}_math.h": render_source.mathematics(options),
        f"src/{name}_selftest.c": render_tests.selftest(words, options, parts.close),
        f"src/{name}_vectors.h": render_tests.vectors_header(
            core, few, words, options, "vectors"
        ),
    }
    if parts.exact is not None:
        files[f"src/{name}_qp.h"] = render_source.solver(parts.exact, options)
    return files


def _tests(parts: _Parts) -> dict[str, str]:
    core, options, words = parts.core, parts.options, parts.words
    return {
        f"test/{options.prefix}_cases.h": render_tests.vectors_header(
            core, parts.vectors, words, options, "cases"
        ),
        "test/test_host.c": render_tests.host_test(core, words, options, parts.close),
    }
