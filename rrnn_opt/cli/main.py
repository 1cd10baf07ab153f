"""``rrnn``: finds the command, runs it, and turns every end into an exit status.

0 all that was asked holds; 1 something asked does not hold; 2 bad input;
130 interrupted.  Commands are imported here, what they need only when they
run: ``rrnn --help`` loads no numerical library.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from typing import Any, NoReturn

from rrnn_opt.cli import (
    check,
    demo,
    doctor,
    generate,
    plan,
    robots,
    simulate,
    verify,
    view,
)
from rrnn_opt.cli.folders import os_sentence
from rrnn_opt.cli.output import Output, UsageError, opened
from rrnn_opt.errors import RrnnError

COMMANDS: dict[str, Any] = {
    "demo": demo,
    "plan": plan,
    "check": check,
    "view": view,
    "simulate": simulate,
    "generate": generate,
    "verify": verify,
    "robots": robots,
    "doctor": doctor,
}
FAILED, BAD_INPUT, INTERRUPTED = 1, 2, 130


class _Parser(argparse.ArgumentParser):
    """A parser that raises instead of leaving."""

    def error(self, message: str) -> NoReturn:
        raise UsageError(f"{message} (see {self.prog} --help)")


def parser() -> argparse.ArgumentParser:
    """The parser of all commands."""
    top = _Parser(
        prog="rrnn",
        description="One symbolic law in; a proof, a solver, a plan and a controller"
        " out.",
    )
    top.add_argument("--version", action="version", version=_version())
    commands = top.add_subparsers(dest="command", metavar="COMMAND", required=True)
    for name, module in COMMANDS.items():
        command = commands.add_parser(name, help=module.HELP, description=module.HELP)
        module.add_arguments(command)
        command.add_argument(
            "--json", action="store_true", help="print one JSON document"
        )
        command.add_argument(
            "--debug", action="store_true", help="show the traceback of an error"
        )
    return top


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command.

    Args:
        argv: arguments after the program's name; the process's by default.

    Returns:
        The exit status.
    """
    words = list(sys.argv[1:] if argv is None else argv)
    name = next((word for word in words if word in COMMANDS), "")
    with opened("--json" in words) as out:
        return _guarded(words, name, out)


def _guarded(words: list[str], name: str, out: Output) -> int:
    debug = "--debug" in words
    try:
        args = parser().parse_args(words)
        return int(COMMANDS[args.command].run(args, out))
    except KeyboardInterrupt:
        return _failed(out, name, "interrupted", INTERRUPTED)
    except RrnnError as error:
        if debug:
            raise
        return _failed(out, name, str(error), BAD_INPUT)
    except OSError as error:
        if debug:
            raise
        code = FAILED if out.done else BAD_INPUT
        return _failed(out, name, os_sentence(error), code)
    except Exception as error:
        if debug:
            raise
        hint = "this is a fault of ours: run it again with --debug to see where"
        text = f"{type(error).__name__}: {error}; {hint}"
        return _failed(out, "", text, FAILED)


def _failed(out: Output, name: str, text: str, code: int) -> int:
    """Say what went wrong; with ``--json`` also as a document."""
    sentence = " ".join(text.split())
    out.note(f"rrnn: {sentence}")
    kind = {FAILED: "failed", BAD_INPUT: "bad_input", INTERRUPTED: "interrupted"}[code]
    describe = getattr(COMMANDS.get(name), "failure", None)
    if describe is not None:
        out.document(describe(kind, sentence))
    else:
        out.document({"error": {"kind": kind, "message": sentence}})
    return code


def _version() -> str:
    from importlib import metadata

    return f"rrnn_opt {metadata.version('rrnn_opt')}"


if __name__ == "__main__":
    sys.exit(main())
