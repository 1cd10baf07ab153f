"""``rrnn check``: judge a plan or a claim's certificate again, independently."""

from __future__ import annotations

import argparse
import json
from typing import Any

from rrnn_opt.cli.output import Output
from rrnn_opt.errors import DocumentError, RrnnError
from rrnn_opt.files import read_json

HELP = "judge a plan result or a claim's certificate again"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's arguments."""
    parser.add_argument("file", metavar="FILE.json", help="plan.json or a certificate")
    parser.add_argument(
        "--exact",
        action="store_true",
        help="prove every interval of a plan again in ball arithmetic (seconds)",
    )


def run(args: argparse.Namespace, out: Output) -> int:
    """0 it holds, 1 it does not hold or is UNKNOWN."""
    document = read(args.file)
    answer = judged(document, exact=args.exact)
    out.document(answer)
    for line in _lines(answer):
        out.say(line)
    if answer["kind"] != "claim" and not as_built_in(document):
        name = document["problem"]["robot"]
        out.note(f"judged with the file's robot, which is not the built-in {name}")
    return 0 if answer["holds"] else 1


def judged(document: dict[str, Any], *, exact: bool = False) -> dict[str, Any]:
    """The checker's answer as plain data; ``holds`` is among it.

    Args:
        document: a plan result or a certificate.
        exact: prove a plan's intervals again in ball arithmetic.

    Raises:
        DocumentError: it is neither a plan result nor a certificate.
    """
    from rrnn_opt.check import check_plan
    from rrnn_opt.check.claims.certificate import KIND, check_certificate

    if document.get("kind") == KIND:
        return {"kind": "claim", **check_certificate(document).to_dict()}
    if isinstance(document.get("claims"), list):
        raise DocumentError(
            "claims", "are rows of a report: check one of the certificates beside it"
        )
    return check_plan(document, exact=exact).to_dict()


def as_built_in(document: dict[str, Any]) -> bool:
    """Is the robot of a plan the one that its problem names, if that is built in?

    The checker takes every number from the file and knows no robot by name.
    """
    from rrnn_opt.planning import Problem
    from rrnn_opt.robot.builtin import BUILTIN

    problem = document.get("problem")
    name = problem.get("robot") if isinstance(problem, dict) else None
    if not isinstance(name, str) or name not in BUILTIN:
        return True
    try:
        robot = Problem.from_dict(problem).robot.to_dict()
    except RrnnError:  # what is wrong with the problem is not asked here
        return True
    return bool(json.loads(json.dumps(robot)) == document.get("robot"))


def read(path: str) -> dict[str, Any]:
    """The JSON object that a file holds.

    Raises:
        DocumentError: it cannot be read, or holds something else.
    """
    document = read_json(path)
    if not isinstance(document, dict):
        raise DocumentError(path, "is JSON, but not an object")
    return document


def _lines(answer: dict[str, Any]) -> list[str]:
    from rrnn_opt.report import check_line

    if answer["kind"] == "claim":
        word = f"claim {answer['status']}: {answer['reason']}"
        return [check_line(word, answer["holds"])]
    lines = [f"plan, status: {answer['status']}"]
    found = answer["certificate"]
    if found is None:
        lines.append(check_line("there is no trajectory to judge", False))
    else:
        for key in ("collision_free", "limits"):
            lines.append(check_line(f"{key}: {found[key]}", found[key] == "PROVED"))
        lines.append(check_line("goal reached", found["goal_reached"]))
        faults = [*found["faults"], *_witnesses(found)]
        lines += [check_line(fault, False) for fault in faults]
    return lines + [check_line(text, False) for text in answer["disagreements"]]


def _witnesses(found: dict[str, Any]) -> list[str]:
    """Where the motion breaks something, in words."""
    words = []
    for key in ("witness", "limits_witness"):
        witness = found.get(key)
        if witness:
            facts = {k: v for k, v in witness.items() if k != "q"}
            words.append("witness: " + ", ".join(f"{k} {v}" for k, v in facts.items()))
    return words
