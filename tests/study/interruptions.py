"""A study in a process of its own, to be ended from outside."""

import subprocess
import sys
import textwrap

SCRIPT = """
    import resource, signal, sys
    from pathlib import Path
    from rrnn_opt.study import Results, parts
    from studies_for_tests import Draws
    parts.available = lambda: False
    limit = int(sys.argv[2])
    if limit:
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
    with Results(Path(sys.argv[1])) as results:
        for row in results.run(Draws(40, wait_s=float(sys.argv[3]))):
            print(row.key, flush=True)
"""


def start(folder, *, limit=0, wait_s=0.0):
    words = [str(folder), str(limit), str(wait_s)]
    return subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(SCRIPT), *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
