"""``rrnn verify``: verdicts about the paper's statements, or about your own."""

from __future__ import annotations

import argparse
import json
import runpy
from pathlib import Path
from typing import Any

from rrnn_opt.cli import named
from rrnn_opt.cli.arguments import seed
from rrnn_opt.cli.folders import folder
from rrnn_opt.cli.output import Output, UsageError

HELP = "settle claims: PROVED, REFUTED with a witness, or UNKNOWN"
OPEN = ("REFUTED", "UNKNOWN")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's arguments."""
    parser.add_argument(
        "claim", nargs="*", help="an id such as C17, or a Python file with claims()"
    )
    parser.add_argument("--all", action="store_true", help="every claim of the paper")
    parser.add_argument("--robot", default="pa10", help="default %(default)s")
    parser.add_argument("--seed", type=seed, default=0, help="default 0")
    parser.add_argument("--out", metavar="DIR", help="write the certificates here")


def run(args: argparse.Namespace, out: Output) -> int:
    """0 when every verdict is the expected one, else 1."""
    target = folder(args.out) if args.out is not None else None
    settled = [case.settle(seed=args.seed) for case in chosen(args)]
    rows = [one.row(certificate=_write(one, target)) for one in settled]
    out.document({"claims": rows, "evidence": []})
    for one, row in zip(settled, rows, strict=True):
        word = "PASS" if one.as_expected else "FAIL"
        out.say(
            f"{word}  {row['id']} {row['verdict']} ({row['engine']}): {row['reason']}"
        )
        out.say(f"      {row['statement']}")
        if row["mutation"]:
            out.say(f"      mutation: {row['mutation']}")
    return 0 if all(one.as_expected for one in settled) else 1


def chosen(args: argparse.Namespace) -> list[Any]:
    """The cases that the command line names.

    Raises:
        UsageError: nothing or something unknown is named.
    """
    files = [name for name in args.claim if name.endswith(".py")]
    ids = [name.replace("'", "p") for name in args.claim if name not in files]
    if not args.claim and not args.all:
        raise UsageError("name a claim, a Python file with claims(), or --all")
    cases = _printed(args.robot, ids, everything=args.all) if ids or args.all else []
    for name in files:
        cases += _own(name)
    return cases


def _printed(robot: str, ids: list[str], *, everything: bool) -> list[Any]:
    from rrnn_opt.robot import Kinematics
    from rrnn_opt.validation.claims import claims

    cases = {case.claim.id: case for case in claims(Kinematics(named.robot(robot)))}
    for name in ids:
        if name not in cases:
            raise UsageError(named.unknown("claim", name, cases))
    return list(cases.values()) if everything else [cases[name] for name in ids]


def _own(path: str) -> list[Any]:
    """The claims of a user's file; each is expected to be settled and to hold."""
    from rrnn_opt.verification import ClaimCase, Status

    try:
        found = runpy.run_path(path)["claims"]()
    except KeyError:
        raise UsageError(f"{path} defines no function claims()") from None
    except OSError as error:
        raise UsageError(f"{path}: cannot be read ({error.strerror})") from error
    return [
        claim if isinstance(claim, ClaimCase) else ClaimCase(claim, Status.PROVED)
        for claim in found
    ]


def _write(settled: Any, target: Path | None) -> str | None:
    """Write the claim's certificate, if there is one; its path."""
    certificate = settled.verdict.certificate
    if target is None or certificate is None:
        return None
    from rrnn_opt.report import write_text

    text = json.dumps(certificate, indent=1, allow_nan=False) + "\n"
    return str(write_text(target / f"{settled.case.claim.id}.json", text))
