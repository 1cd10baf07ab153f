"""From network dynamics to a C99 package."""

from __future__ import annotations

from typing import Any

from rrnn_opt.dynamics import Dynamics
from rrnn_opt.embedding import documents, render, render_source, render_tests
from rrnn_opt.embedding.kernel import kernel
from rrnn_opt.embedding.manifest import facts
from rrnn_opt.embedding.options import Options
from rrnn_opt.embedding.package import Package, with_manifest
from rrnn_opt.embedding.programme import programme
from rrnn_opt.embedding.target.files import target_files
from rrnn_opt.embedding.vectors import SELFTEST_CASES, reference_vectors, tolerance


def generate(dynamics: Dynamics, **options: Any) -> Package:
    """Make a C99 package of a network: ``steps`` Euler steps in one call.

    The step is x+ = x + h f(x, parameters), emitted from the same expression
    graph that is simulated and proved.  Nothing in the package depends on the
    date or the machine: the same model gives the same bytes.

    Args:
        dynamics: the network.
        **options: fields of ``Options``: prefix, real, steps, step_size, ...

    Returns:
        The package; ``.write(out_dir)`` makes its folder.

    Raises:
        RrnnError: an option cannot be used.
        UnsupportedOperationError: the graph holds an operation without C text.
    """
    wanted = Options(**options)
    core = kernel(dynamics)
    exact = programme(dynamics) if wanted.fallback else None
    vectors = reference_vectors(core, wanted)
    close = tolerance(core, wanted, vectors)
    longest = None
    words = render.common_words(core, wanted, exact, longest)
    prefix = wanted.prefix
    few = vectors[:SELFTEST_CASES]

    def cases(which: list[Any], name: str) -> str:
        return render_tests.vectors_header(core, which, words, wanted, name)

    files = {
        f"include/{prefix}.h": render_source.header(core, wanted, words),
        f"src/{prefix}.c": render_source.source(core, wanted, words, exact, longest),
        f"src/{prefix}_math.h": render_source.mathematics(wanted),
        f"src/{prefix}_selftest.c": render_tests.selftest(words, wanted, close),
        f"src/{prefix}_vectors.h": cases(few, "vectors"),
        f"test/{prefix}_cases.h": cases(vectors, "cases"),
        "test/test_host.c": render_tests.host_test(core, words, wanted, close),
        "README.md": documents.readme(core, words, wanted, close),
        "LICENSE": render.verbatim("APACHE-2.0.md"),
    }
    if exact is not None:
        files[f"src/{prefix}_qp.h"] = render_source.solver(exact, wanted)
    files |= target_files(wanted, words)
    return with_manifest(prefix, files, facts(core, wanted))
