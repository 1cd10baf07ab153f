"""``rrnn verify``: verdicts about the paper, a scheme on a robot, or your claims."""

from __future__ import annotations

import argparse
import json
from collections.abc import Mapping, Sequence
from inspect import signature
from pathlib import Path
from typing import Any

from rrnn_opt.cli import named
from rrnn_opt.cli.arguments import seed
from rrnn_opt.cli.folders import folder
from rrnn_opt.cli.output import Output, UsageError
from rrnn_opt.files import from_python

HELP = "settle claims: PROVED, REFUTED with a witness, HOLDS_UNDER, or UNKNOWN"
OPEN = ("REFUTED", "UNKNOWN")
TITLE = "Statements of the paper, and what is true"
READ = (
    "Statements are in our words; how each was read stands in its file in "
    "validation/claims. "
)
WORDS = (
    "PROVED adds no hypothesis to the source's own, HOLDS_UNDER "
    "names those that it needs, REFUTED has a point that was replayed exactly; "
    "assumptions that begin with pen are steps that no checker follows. Any verdict "
    "is judged again by rrnn check DIR/ID.json."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's arguments."""
    parser.add_argument(
        "claim", nargs="*", help="an id such as C17, or a Python file with claims()"
    )
    parser.add_argument("--all", action="store_true", help="every claim of the paper")
    parser.add_argument(
        "--formulation", metavar="NAME", help="what is claimed of a scheme"
    )
    parser.add_argument("--network", default="PrimalDual", help="default %(default)s")
    parser.add_argument("--robot", default="pa10", help="default %(default)s")
    parser.add_argument("--seed", type=seed, default=0, help="default 0")
    parser.add_argument(
        "--out", metavar="DIR", help="write certificates and a report here"
    )


def run(args: argparse.Namespace, out: Output) -> int:
    """0 when every verdict is the expected one, else 1."""
    target = folder(args.out) if args.out is not None else None
    certificates = None if target is None else Certificates(target)
    printed, others = chosen(args)
    rows: list[dict[str, Any]] = []
    missed: list[str] = []
    for entry in (*printed, *others):
        row, caught = _row(entry, certificates, args.seed)
        rows.append(row)
        out.note(f"{row['id']} {row['verdict']} ({row['time_s']:.1f} s)")
        missed += [] if caught else [f"{row['id']}: its mutation was not caught"]
    missed += _surprises(rows[: len(printed)]) + _open(rows[len(printed) :])
    evidence = [e.to_dict() for x in (*printed, *others) for e in _evidence(x)]
    document = {"claims": rows, "evidence": evidence}
    out.document(document)
    _say(document, missed, out)
    if target is not None and certificates is not None:
        certificates.require_written()
        _report(document, target, args)
    return 1 if missed else 0


def chosen(args: argparse.Namespace) -> tuple[list[Any], list[Any]]:
    """Entries of the paper, and others, that the command line names.

    Raises:
        UsageError: nothing or something unknown is named.
    """
    files = [name for name in args.claim if name.endswith(".py")]
    ids = [name.replace("'", "p") for name in args.claim if name not in files]
    if not (args.claim or args.all or args.formulation):
        raise UsageError(
            "name a claim, a Python file with claims(), --formulation, or --all"
        )
    printed = _printed(args.robot, ids, everything=args.all) if ids or args.all else []
    others = [case for name in files for case in _own(name)]
    if args.formulation:
        others += _scheme(args)
    return printed, others


def _printed(robot: str, ids: list[str], *, everything: bool) -> list[Any]:
    from rrnn_opt.robot import Kinematics
    from rrnn_opt.validation.claims import IDS, claims

    for name in ids:
        if name not in IDS:
            raise UsageError(named.unknown("claim", name, IDS))
    wanted = None if everything else ids
    return list(claims(Kinematics(named.robot(robot)), wanted))


def _own(path: str) -> list[Any]:
    """The claims of a user's file."""
    from rrnn_opt.claim import Claim
    from rrnn_opt.decay import DecayClaim
    from rrnn_opt.verification import ClaimCase, Proof, Remark

    found = from_python(path, "claims")
    for entry in found:
        if not isinstance(entry, ClaimCase | Remark | Claim | DecayClaim | Proof):
            kind = type(entry).__name__
            raise UsageError(f"{path}: claims() gives claims, not a {kind}")
    return [x if isinstance(x, ClaimCase | Remark) else ClaimCase(x) for x in found]


def _scheme(args: argparse.Namespace) -> list[Any]:
    """What is claimed of a formulation and its network on a robot."""
    from rrnn_opt.robot import Kinematics
    from rrnn_opt.verification.catalogue import claims

    kinematics = Kinematics(named.robot(args.robot))
    scheme, spheres = named.scheme(args.formulation), kinematics.robot.spheres
    takes = "contacts" in signature(scheme).parameters and spheres
    contacts = (len(spheres) - 1,) if takes else ()
    form = scheme(kinematics, **({"contacts": contacts} if takes else {}))
    network = named.network(args.network)
    found: list[Any] = claims(form, network, kinematics, contacts=contacts)
    return found


def _row(
    entry: Any, certificates: Certificates | None, number: int
) -> tuple[dict[str, Any], bool]:
    """The row of an entry, and whether its mutation was caught."""
    if not hasattr(entry, "settle"):
        return entry.row(), True
    settled = entry.settle(seed=number)
    return settled.row(place=certificates), settled.caught


class Certificates:
    """A folder of certificates; verdicts outlive a disk that fills up.

    Args:
        target: the folder.
    """

    def __init__(self, target: Path) -> None:
        self._target = target
        self._error: OSError | None = None

    def __call__(self, name: str, certificate: Mapping[str, Any]) -> str | None:
        """Write one; its path, or None where that failed."""
        from rrnn_opt.report import file_name, write_text

        text = json.dumps(certificate, indent=1, allow_nan=False) + "\n"
        try:
            return str(write_text(self._target / f"{file_name(name)}.json", text))
        except OSError as error:
            self._error = self._error or error
            return None

    def require_written(self) -> None:
        """Raise what kept the first certificate from being written.

        Raises:
            OSError: there was such a thing.
        """
        if self._error is not None:
            raise self._error


def _surprises(rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """Rows of the paper that did not come out as expected; read last of all."""
    if not rows:
        return []
    from rrnn_opt.validation.claims.expected import surprises

    return [f"{name}: expected {word}" for name, word in surprises(rows).items()]


def _open(rows: Sequence[Mapping[str, Any]]) -> list[str]:
    return [f"{r['id']}: {r['verdict']}" for r in rows if r["verdict"] in OPEN]


def _evidence(entry: Any) -> Sequence[Any]:
    return tuple(getattr(entry, "evidence", ()))


def _report(
    document: Mapping[str, Any], target: Path, args: argparse.Namespace
) -> None:
    from rrnn_opt.report import claims_html, claims_markdown, write_text

    words = [*args.claim, *(["--all"] if args.all else [])]
    if args.formulation:
        words += ["--formulation", args.formulation, "--network", args.network]
    own = all(name.endswith(".py") for name in words)
    words += [] if own else ["--robot", args.robot]
    about = {
        "title": TITLE if args.all else "Claims",
        "command": " ".join(["rrnn verify", *words, "--out", "DIR"]),
        "words": WORDS if own else READ + WORDS,
    }
    write_text(target / "claims.json", json.dumps(document, indent=1) + "\n")
    write_text(target / "claims.md", claims_markdown(document, **about))
    write_text(target / "claims.html", claims_html(document, **about))


def _say(document: Mapping[str, Any], missed: Sequence[str], out: Output) -> None:
    from rrnn_opt.report import claims_table

    rows = document["claims"]
    out.say(claims_table(rows))
    if len(rows) <= 3:
        for row in rows:
            out.say(f"{row['id']}: {row['statement']}")
            out.say(f"    {row['reason']}")
            if row["mutation"]:
                out.say(f"    mutation: {row['mutation']}")
    for line in missed:
        out.say(f"FAIL  {line}")
