"""``rrnn compare``: QP solvers and networks side by side, judged by us."""

from __future__ import annotations

import argparse
import shlex
import sys
from pathlib import Path
from textwrap import wrap
from typing import Any

from rrnn_opt.cli.arguments import count, seed
from rrnn_opt.cli.folders import folder
from rrnn_opt.cli.output import Output, UsageError

HELP = "compare QP solvers and networks on control streams and drawn problems"
PATIENCE_S = 180.0
"""Wall time that one solver may take on one set, s."""
SETS_WIDTH = 64
"""Letters of a line of sets."""
MANY = 50
"""Cases from which on a shorter way is named."""
NOTHING = (
    "name a study: rrnn compare quick --solvers osqp,daqp,rrnn is the quick way, all"
    " solvers take ten times as long; rrnn compare --list shows what there is"
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's arguments."""
    parser.add_argument(
        "study",
        nargs="?",
        help="a name of --list, a Python file with cases(), a folder of .npz files"
        " (qpsolvers.Problem.save), or a .parquet test set",
    )
    parser.add_argument("--list", action="store_true", help="studies and solvers")
    parser.add_argument("--solvers", metavar="A,B,..", help="only these (default: all)")
    parser.add_argument("--passes", type=count, default=5, help="default %(default)s")
    parser.add_argument("--export", metavar="DIR", help="write the sets as Parquet")
    add_study_arguments(parser)


def add_study_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of every command that runs a study."""
    add = parser.add_argument
    add("--jobs", type=count, default=1, help="worker processes; default %(default)s")
    add("--dask", metavar="ADDRESS", help="of a Dask scheduler instead")
    add("--out", metavar="DIR", default="runs/{}", help="default runs/COMMAND")
    add("--resume", action="store_true", help="go on in DIR")
    add("--seed", type=seed, default=0, help="default 0")


def run(args: argparse.Namespace, out: Output) -> int:
    """0 when every case was measured; 1 when one crashed or took too long.

    Raises:
        UsageError: no study is named.
    """
    from rrnn_opt.study import pin_threads

    pin_threads()
    if args.list:
        return _list(out)
    if args.study is None:
        raise UsageError(NOTHING)
    study, notes = chosen_study(args)
    if args.export is not None:
        return _export(study, folder(args.export), out)
    target = folder(args.out.replace("{}", "compare"))
    for line in intended(args, study, target):
        out.note(line)
    rows = measured(args, study, target)
    paths = _report(args, study, rows, target, notes)
    return _said(out, study, rows, paths)


def chosen_study(args: argparse.Namespace) -> tuple[Any, tuple[str, ...]]:
    """The comparison that the command line names, and why sets are left out.

    Raises:
        UsageError: no set of the study can be made here.
    """
    from rrnn_opt.study import comparison

    words = [word for word in (args.solvers or "").split(",") if word]
    solvers = comparison.chosen(words)
    if comparison.is_own(args.study):
        own = comparison.own_sets(args.study)
        return comparison.Comparison(tuple(own), solvers, own, args.passes), ()
    names, notes = comparison.installed(comparison.set_names(args.study))
    if not names:
        raise UsageError("; ".join(notes))
    return comparison.Comparison(names, solvers, passes=args.passes), notes


def intended(args: argparse.Namespace, study: Any, target: Path) -> list[str]:
    """What is about to be done, how long it may take, and how to stop it."""
    cases, most = sum(1 for _ in study), f" and is ended after {PATIENCE_S:g} s"
    lines = [
        f"{cases} cases (solvers: {len(study.solvers)}, sets: {len(study.sets)},"
        f" passes: {args.passes}); a case takes seconds"
        f"{most if args.dask is None else ''}. Ctrl-C keeps what is finished in"
        f" {target}, --resume goes on there"
    ]
    if args.solvers is None and cases > MANY:
        lines.append(
            "this asks every solver that is installed; --solvers osqp,daqp,rrnn is the"
            " quick way"
        )
    return lines


def measured(args: argparse.Namespace, study: Any, target: Path) -> list[Any]:
    """Rows of the study, those of workers that died at the end."""
    from rrnn_opt.study import Cluster, Processes, Progress, Results

    workers: Any = Processes(args.jobs, patience_s=PATIENCE_S)
    if args.dask is not None:
        workers = Cluster(args.dask)
    progress = Progress(sys.stderr, label=f"{study.name} ")
    results = Results(target / "rows", seed=args.seed, resume=args.resume)
    try:
        with results:
            found = results.run(study, workers=workers, progress=progress)
            lost = [row for row in found if row.lost]
            return [*results.rows(study), *lost]
    finally:
        progress.close()


def command_line(name: str, args: argparse.Namespace) -> str:
    """The command as it was given."""
    words = sys.argv[1:] if sys.argv[1:2] == [name] else [name, str(args.study)]
    return " ".join(["rrnn", *map(shlex.quote, words)])


def _report(
    args: argparse.Namespace, study: Any, rows: list[Any], target: Path, notes: Any
) -> tuple[Path, ...]:
    from rrnn_opt.study import comparison, environment, rows_digest
    from rrnn_opt.study.identity import PACKAGES

    packages = dict.fromkeys([*PACKAGES, *(who.package for who in study.solvers)])
    settings = {"passes": args.passes, "jobs": args.jobs, "dask": args.dask}
    return comparison.write_report(
        target,
        study,
        rows,
        environment=environment(settings, packages=packages),
        command=command_line("compare", args),
        digest=rows_digest(rows),
        notes=notes,
    )


def _said(out: Output, study: Any, rows: list[Any], paths: tuple[Path, ...]) -> int:
    from rrnn_opt.report import table
    from rrnn_opt.study.comparison import summaries
    from rrnn_opt.study.comparison.advice import advice

    found = summaries(rows)
    out.document({"rows": found, "files": [str(path) for path in paths]})
    head = ("set", "solver", "mode", "n", "solved", "p50 us", "worst us")
    lines = []
    for row in (row for row in found if row["n"]):  # neither infeasible nor failed
        times = row["time_us"] or {}
        given = (row["stream"], row["solver"], row["mode"], row["n"], row["solved"])
        lines.append((*given, times.get("p50"), times.get("max")))
    out.say(table(head, lines))
    for sentence in advice(rows, study.sets):
        out.say(sentence.replace("**", ""))
    for row in rows:
        if row.error:
            out.note(f"{row.key}: {row.error}")
    for path in paths:
        out.say(f"  {path}")
    return 1 if any(row.error for row in rows) else 0


def _export(study: Any, target: Path, out: Output) -> int:
    """Write every set in the form that qpbenchmark reads."""
    from rrnn_opt.study.comparison import write_test_set

    paths = []
    for name in study.sets:
        file = target / f"{name.replace('/', '_')}.parquet"
        paths.append(write_test_set(study.problems(name), file))
        out.say(str(paths[-1]))
    out.document({"files": [str(path) for path in paths]})
    return 0


def _list(out: Output) -> int:
    from rrnn_opt.report import table
    from rrnn_opt.study.comparison import GROUPS, entrants

    known = {name: list(sets) for name, sets in GROUPS.items()}
    who = [
        {
            "name": e.name,
            "method": e.method,
            "licence": e.licence,
            "package": f"{e.package} {e.version()}".strip(),
            "modes": list(e.modes),
        }
        for e in entrants()
    ]
    out.document({"studies": known, "solvers": who})
    rows = [
        (name if k == 0 else "", line)
        for name, sets in known.items()
        for k, line in enumerate(wrap(", ".join(sets), SETS_WIDTH))
    ]
    out.say(table(("study", "sets"), rows))
    out.say()
    lines = [[*list(e.values())[:-1], ", ".join(e["modes"])] for e in who]
    out.say(table(("solver", "method", "licence", "package", "modes"), lines))
    return 0
